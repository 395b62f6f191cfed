#pragma once

#include "state/world_record.hpp"

namespace pydart2 {

/// Collision detection needs differences of coordinates: contacts of bodies that are too far out have normals that are
/// not numbers. ODE ends the process where a coordinate in cells of its hash space, 1/8 m and larger, is no 32-bit integer.
/// Throws BlowUp with the body or shape that is too far out.
void check_range(const WorldRecord& record, SkeletonRecord& item, double time, const TreeDynamics* mover = nullptr);

/// The same of the free bodies of the record's plan.
void check_range_of_free(const WorldRecord& record, double time);

} // namespace pydart2
