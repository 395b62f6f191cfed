#pragma once

#include <algorithm>
#include <limits>

#include "collision/native_geometry.hpp"

namespace pydart2::native {

/// From a point into a direction of length 1, in the frame of what it is cast at.
struct Ray
{
  Vector origin, direction;

  Vector at(double distance) const { return origin + distance * direction; }
};

/// Where a ray first comes through a surface.
struct RayHit
{
  double distance = std::numeric_limits<double>::infinity();
  Vector normal = Vector::Zero(); ///< Outwards; of triangles, towards where the ray comes from.
};

/// Whether a ray hits a shape sooner than `hit`, which then is that hit. Solids are hit where the ray enters them: one
/// that begins inside passes out of them. The triangles of a mesh are hit from both sides.
bool cast(const Ray& ray, const Geometry& shape, RayHit& hit);

/// Where a ray enters a box, 0 for one that begins inside; infinity if it misses it.
inline double entry(const Ray& ray, const Vector& inverse_direction, const Bounds& box)
{
  constexpr double never = std::numeric_limits<double>::infinity();
  double from = 0.0, to = never;
  for (int i = 0; i < 3; ++i) {
    if (ray.direction[i] == 0.0) {
      if (ray.origin[i] < box.low[i] || ray.origin[i] > box.high[i])
        return never;
      continue;
    }
    const double low = (box.low[i] - ray.origin[i]) * inverse_direction[i], high = (box.high[i] - ray.origin[i]) * inverse_direction[i];
    from = std::max(from, std::min(low, high));
    to = std::min(to, std::max(low, high));
  }
  return from <= to * (1.0 + 1e-12) ? from : never; // a flat box is one too
}

} // namespace pydart2::native
