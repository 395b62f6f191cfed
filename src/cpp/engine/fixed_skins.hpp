#pragma once

#include <dart/constraint/ConstraintSolver.hpp>

namespace pydart2 {

/// Takes the contacts of soft bodies between two bodies that do not move out of what a solver is about to solve: the engine
/// makes constraints of them, which it then refuses to solve.
void drop_fixed_skins(dart::constraint::ConstraintSolver& solver);

} // namespace pydart2
