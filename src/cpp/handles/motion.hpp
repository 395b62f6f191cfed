#pragma once

#include <dart/dynamics/BodyNode.hpp>

#include "state/world_record.hpp"

namespace pydart2 {

/// Bring a body's pose, or its velocity, up to date by the code that moves its skeleton: the engine needs longer.
void find_pose(const WorldRecord& world, const SkeletonRecord& skeleton, const dart::dynamics::BodyNode& body);
void find_velocity(const WorldRecord& world, const SkeletonRecord& skeleton, const dart::dynamics::BodyNode& body);

} // namespace pydart2
