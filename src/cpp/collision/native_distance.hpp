#pragma once

#include "collision/native_geometry.hpp"

namespace pydart2::native {

/// How two convex shapes' cores lie to each other, in the frame of the first.
struct Separation
{
  Vector normal = Vector::UnitZ(); ///< From the second to the first.
  double distance = 0.0; ///< Between the cores; below 0: the least way that parts them.
  Vector on_a = Vector::Zero(), on_b = Vector::Zero(); ///< The points of the cores that are this far apart.
};

/// False if the cores are farther apart than `most`. Where they are apart: the algorithm of Gilbert, Johnson and Keerthi
/// (1988); where they are not, that of van den Bergen (2001), which grows a polytope inside the Minkowski difference.
bool separation(const Geometry& a, const Geometry& b, const Pose& b_in_a, double most, Separation& out);

} // namespace pydart2::native
