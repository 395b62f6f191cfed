#pragma once

#include "archive.hpp"
#include "world_record.hpp"

namespace pydart2 {

/// All that a step changes and the next one depends on: time, frame, positions, velocities, accelerations, forces,
/// commands, external forces, constraint impulses, the points of soft bodies.
void visit_state(Archive& archive, WorldRecord& world);

/// Empties what has a memory of the steps before: FCL's tree, Bullet's contact cache, the multipliers of ball joint
/// constraints. The next step then depends on the state alone.
void forget_history(WorldRecord& world);

} // namespace pydart2
