#pragma once

#include "state/blueprint.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

/// From now on a skeleton is made again from what it is, not from what it was loaded from; ValueError if it has what
/// cannot be made so, as soft bodies.
void mark_built(WorldRecord& world, SkeletonRecord& record);

/// The root joint has changed: copies are to do the same, and of several trees the engine has this one as the last now.
void note_root_change(WorldRecord& world, SkeletonRecord& record, RootChange change);

Blueprint blueprint_of(WorldRecord& world);

/// A world of its own that is equal in everything. LoadError if a file is gone, ValueError if it has changed.
WorldRef build(const Blueprint& blueprint);

} // namespace pydart2
