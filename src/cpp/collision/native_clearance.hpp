#pragma once

#include "collision/native_geometry.hpp"

namespace pydart2::native {

/// How far two shapes are from each other.
struct Clearance
{
  double distance = 0.0; ///< m; below 0: the least way that parts two convex shapes. Of other meshes that touch: 0.
  Vector on_a = Vector::Zero(), on_b = Vector::Zero(); ///< The points of the surfaces that are this far apart.
  Vector normal = Vector::UnitZ(); ///< From b to a, of length 1.
};

/// The same seen from outside of the frame whose pose is given.
Clearance moved(const Pose& pose, const Clearance& inside);

/// False if the shapes are farther apart than `most`, and for two planes. In the frame of a.
bool clearance(const Geometry& a, const Geometry& b, const Pose& b_in_a, double most, Clearance& out);

} // namespace pydart2::native
