#pragma once

#include "state/world_record.hpp"

namespace pydart2 {

/// Throws Kind::simulation where a limit that the next step acts on has its lower bound above its upper one, which the
/// engine asserts in calls that may not throw. Positions and velocities of joints that enforce their limits or are SERVO,
/// forces of SERVO and MIMIC joints. Looks again only after SkeletonRecord::limits_checked was taken back.
void check_limits(WorldRecord& world);

/// Warns once of a skeleton of which a dof has gone far beyond limits that do not act: a turn, or the length of the range.
void tell_of_limits(const WorldRecord& world);

} // namespace pydart2
