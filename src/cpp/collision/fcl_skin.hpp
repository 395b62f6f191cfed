#pragma once

#include <dart/dynamics/SoftMeshShape.hpp>
#include <fcl/geometry/bvh/BVH_model.h>

namespace pydart2 {

/// A tree over the triangles of a soft body.
using SkinTree = fcl::BVHModel<fcl::OBBRSS<double>>;

/// Moves the triangles of a tree to where the skin's points are, and fits the boxes of its nodes around where they are
/// and were, as the engine does. Of each node FCL also fits a rounded rectangle, which is most of the time that this takes
/// and which only its distances ask for: they stay as they were.
void move_skin(SkinTree& tree, dart::dynamics::SoftMeshShape& skin);

} // namespace pydart2
