#pragma once

#include <dart/dynamics/Skeleton.hpp>

#include "base/archive.hpp"

namespace pydart2 {

/// What is in a skeleton's joints and dofs, for visit_model().
void visit_joints(Archive& archive, dart::dynamics::Skeleton& skeleton);

/// A vector that normalizing, as the engine's setters of axes do, turns into exactly this unit vector. Normalizing a
/// unit vector changes the last digit of one in three.
Eigen::Vector3d before_normalizing(const Eigen::Vector3d& unit);

} // namespace pydart2
