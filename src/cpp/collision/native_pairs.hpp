#pragma once

#include "collision/native_manifold.hpp"

namespace pydart2::native {

/// Appends the contact points of two shapes that touch, or are no farther apart than `margin`, in the frame of the first.
void collide(const Geometry& a, const Geometry& b, const Pose& b_in_a, double margin, Points& points);

/// The same for two convex shapes, neither a plane nor a mesh.
void collide_convex(const Geometry& a, const Geometry& b, const Pose& b_in_a, double margin, Points& points);

} // namespace pydart2::native
