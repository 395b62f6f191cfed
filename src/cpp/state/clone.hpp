#pragma once

#include "state/blueprint.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

/// From now on a skeleton is made again from what it is, not from what it was loaded from; ValueError if it has what
/// cannot be made so, as soft bodies.
void mark_built(WorldRecord& world, SkeletonRecord& record);

Blueprint blueprint_of(WorldRecord& world);

/// A world of its own that is equal in everything. LoadError if a file is gone, ValueError if it has changed.
WorldRef build(const Blueprint& blueprint);

} // namespace pydart2
