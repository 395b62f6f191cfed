#pragma once

#include "state/blueprint.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

Blueprint blueprint_of(WorldRecord& world);

/// A world of its own that is equal in everything. LoadError if a file is gone, ValueError if it has changed.
WorldRef build(const Blueprint& blueprint);

} // namespace pydart2
