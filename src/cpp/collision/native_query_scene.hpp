#pragma once

#include <dart/dynamics/ShapeNode.hpp>
#include <unordered_map>

#include "collision/native_clearance.hpp"
#include "collision/native_manifold.hpp"
#include "collision/native_ray.hpp"
#include "collision/native_tree.hpp"

namespace pydart2::native {

/// Shapes as they stand, to be asked about. They are known by their indices in set(), -1 is none of them.
class QueryScene
{
public:
  /// Takes shapes anew; those that it has no form for (Form::none) are left out. What it made of shapes that have not
  /// changed since is kept.
  void set(const std::vector<const dart::dynamics::ShapeNode*>& shapes);

  /// What a ray of the world hits sooner than `hit`.
  int cast(const Ray& ray, RayHit& hit) const;

  /// What is nearer to a point than `found.distance`, seen from the shape: its point is the first.
  int nearest(const Vector& point, Clearance& found) const;

  /// Whether two shapes are no farther apart than `most`; in the world.
  bool clearance(int a, int b, double most, Clearance& found) const;

  /// Appends the contact points of two shapes, in the world.
  void collide(int a, int b, Points& points) const;

  /// Not more than the distance of two shapes; infinite for what has no form.
  double least_distance(int a, int b) const;

private:
  struct Made
  {
    dart::dynamics::ConstShapePtr shape;
    std::size_t version;
    Geometry geometry;
  };
  struct Item
  {
    const Geometry* geometry = nullptr; ///< Null: of no form.
    Pose pose;
    Pose to_shape; ///< From the world.
    Bounds bounds;
  };

  const Geometry& geometry(const dart::dynamics::ConstShapePtr& shape);
  const Item& item(int index) const { return items_[static_cast<std::size_t>(index)]; }
  void cast_at(int index, const Ray& ray, RayHit& hit, int& which) const;

  std::unordered_map<const dart::dynamics::Shape*, Made> made_;
  std::vector<Item> items_;
  std::vector<int> unbounded_;
  BoundsTree tree_;
};

} // namespace pydart2::native
