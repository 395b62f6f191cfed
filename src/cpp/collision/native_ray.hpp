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

/// A ray as it meets boxes.
class BoxRay
{
public:
  explicit BoxRay(const Ray& ray)
    : origin_(ray.origin), inverse_(ray.direction.cwiseInverse().cwiseMax(-largest).cwiseMin(largest))
  {
  }

  /// Where it enters a box, 0 for one that begins inside; infinity if it misses it.
  double entry(const Bounds& box) const
  {
    double from = 0.0, to = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const double low = (box.low[i] - origin_[i]) * inverse_[i], high = (box.high[i] - origin_[i]) * inverse_[i];
      from = std::max(from, std::min(low, high));
      to = std::min(to, std::max(low, high));
    }
    return from <= to * (1.0 + 1e-12) ? from : std::numeric_limits<double>::infinity(); // a flat box is one too
  }

private:
  static constexpr double largest = 1e200; ///< Along an axis that the ray does not move on; finite, so that 0 times it is 0.

  Vector origin_, inverse_;
};

} // namespace pydart2::native
