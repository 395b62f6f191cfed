#pragma once

#include "state/world_record.hpp"

namespace pydart2 {

/// The states of a world: [q, dq] of each skeleton, one after another.
long num_states(const WorldRecord& world);
void write_states(const WorldRecord& world, double* out);
void read_states(WorldRecord& world, const double* in);

} // namespace pydart2
