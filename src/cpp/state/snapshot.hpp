#pragma once

#include <vector>

#include "state/world_record.hpp"

namespace pydart2 {

/// All that a step changes and the next one depends on: time, frame, positions, velocities, accelerations, forces,
/// commands, external forces, constraint impulses, the points of soft bodies, who sleeps. With a warm start, the last numbers
/// are what the solver remembers.
std::vector<double> state_of(WorldRecord& world);

/// Puts it back and forgets the history; ValueError, with nothing changed, if it is not finite or of another model.
void restore_state(WorldRecord& world, const std::vector<double>& state);

/// Empties what has a memory of the steps before that is not in the state: FCL's tree, Bullet's contact cache, the
/// multipliers of ball joint constraints. The next step then depends on the state alone.
void forget_history(WorldRecord& world);

} // namespace pydart2
