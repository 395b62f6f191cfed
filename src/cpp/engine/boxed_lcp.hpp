#pragma once

#include <dart/constraint/ConstrainedGroup.hpp>

namespace pydart2 {

/// What BoxedLcpConstraintSolver::solveConstrainedGroup() asserts and accepted input reaches.
///
/// A matrix that is not symmetric to 1e-6 (ill-conditioned inertias, levers of 1e6 m) from now on throws Kind::engine from
/// the engine's own test for it, whose calls are redirected: 6.12 and 6.13 make them through the library's import table,
/// from frames that clean up. Where a later engine does not, the assertion fails as before.
void make_asymmetry_throw();

/// Takes constraints without a row, a mimic joint's whose error is 0, out of a group: each is asserted to have one.
void remove_empty_constraints(dart::constraint::ConstrainedGroup& group);

} // namespace pydart2
