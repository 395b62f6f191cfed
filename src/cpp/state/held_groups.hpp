#pragma once

#include <unordered_set>

#include "state/world_record.hpp"

namespace pydart2 {

/// Takes the whole step, by the integrator "rk4", of skeletons that constraints of the user's hold, where nothing else has
/// acted on them: no contact, limit or friction of a joint, and no rope. Returns which these are. Where a constraint is off
/// by more than 0.1 mm the engine's rule brings its bodies together first.
std::unordered_set<const dart::dynamics::Skeleton*> move_held_groups(const WorldRecord& record, double dt);

} // namespace pydart2
