#pragma once

#include <cstddef>

#include "state/world_record.hpp"

namespace pydart2 {

/// Numbers per packed contact: point(3), force(3) on the first body, skeleton and body index of both bodies (4),
/// shape index of both (2), normal(3), penetration depth. World frame, m and N; an index is -1 where there is none.
constexpr int contact_columns = 16;

/// The contacts of the last collision pass.
std::size_t num_contacts(const WorldRecord& world);

/// In the engine's order, one row each.
void write_contacts(const WorldRecord& world, double* rows);

/// A packed contact after a skeleton was removed: -1 where it was, and the new indices of those behind it.
void forget_skeleton(double* row, int index);

/// Runs collision detection and solves for the contact forces without a step, and leaves no impulse behind.
void check_collision(WorldRecord& world);

} // namespace pydart2
