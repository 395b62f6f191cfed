#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace dart::dynamics {
class ShapeFrame;
}

namespace pydart2 {

/// A point where two shapes touch, or nearly do. All in world coordinates.
struct ContactPoint
{
  Eigen::Vector3d point; ///< Midway between the two surfaces, m.
  Eigen::Vector3d normal; ///< Of length 1, from b to a, as the engine's contacts have it.
  double depth; ///< How deep the shapes are in each other along the normal, m; below 0: the gap between them.
  const dart::dynamics::ShapeFrame* a;
  const dart::dynamics::ShapeFrame* b;
  /// Which corners, edges, faces or triangles of the two shapes touch: the same in the next step as long as they do.
  /// Two points of one pair never have the same.
  std::uint32_t feature;
};

} // namespace pydart2
