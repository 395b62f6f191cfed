#pragma once

#include <dart/dynamics/ShapeNode.hpp>
#include <unordered_map>

#include "collision/native_tree.hpp"
#include "collision/native_ray.hpp"

namespace pydart2::native {

/// Shapes as they stand, to cast rays at.
class RayScene
{
public:
  /// Takes shapes anew; those that it has no form for (Form::none) are left out. What it made of shapes that have not
  /// changed since is kept.
  void set(const std::vector<const dart::dynamics::ShapeNode*>& shapes);

  /// The index in set()'s shapes of what a ray of the world hits sooner than `hit`, or -1.
  int cast(const Ray& ray, RayHit& hit) const;

private:
  struct Made
  {
    dart::dynamics::ConstShapePtr shape;
    std::size_t version;
    Geometry geometry;
  };
  struct Item
  {
    int index;
    const Geometry* geometry;
    Pose to_shape; ///< From the world.
  };

  const Geometry& geometry(const dart::dynamics::ConstShapePtr& shape);
  void cast_at(std::size_t item, const Ray& ray, RayHit& hit, int& which) const;

  std::unordered_map<const dart::dynamics::Shape*, Made> made_;
  std::vector<Item> items_;
  std::vector<int> unbounded_;
  BoundsTree tree_;
};

} // namespace pydart2::native
