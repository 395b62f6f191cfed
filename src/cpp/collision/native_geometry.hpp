#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <dart/dynamics/Shape.hpp>
#include <memory>
#include <vector>

namespace pydart2::native {

using Vector = Eigen::Vector3d;
using Pose = Eigen::Isometry3d;

struct TriangleMesh;

/// The corners of a convex body and its faces, counterclockwise seen from outside. Without faces: spheres about the
/// corners.
struct Hull
{
  std::vector<Vector> corners;
  std::vector<std::vector<int>> faces;
  std::vector<Vector> normals; ///< Of the faces, outwards.
  std::vector<double> radii; ///< Of the spheres.
};

enum class Form { none, plane, sphere, capsule, box, cylinder, cone, ellipsoid, spheres, hull, triangle, mesh };

/// A shape in its own frame. Spheres and capsules are a core, a point or a segment, with a radius put around it.
struct Geometry
{
  Form form = Form::none;
  Vector half = Vector::Zero(); ///< Half sizes of the core along the axes.
  double radius = 0.0; ///< Put around the core.
  double size = 0.0; ///< The smallest extent; tolerances are parts of it.
  Vector center = Vector::Zero(); ///< Somewhere in the middle.
  Vector normal = Vector::UnitZ(); ///< Of planes and triangles.
  double offset = 0.0; ///< Of planes.
  std::array<Vector, 3> triangle; ///< The corners of a triangle.
  std::shared_ptr<const Hull> hull;
  std::shared_ptr<const TriangleMesh> mesh;
};

/// What collides of an engine's shape; Form::none for what has no solid form here.
Geometry geometry_of(const dart::dynamics::Shape& shape);

/// The point of the core that lies farthest along a direction of any length.
Vector support(const Geometry& shape, const Vector& direction);

/// A box along the axes of the world.
struct Bounds
{
  Vector low, high;

  bool overlaps(const Bounds& other, double margin = 0.0) const
  {
    return (low.array() <= other.high.array() + margin).all() && (other.low.array() <= high.array() + margin).all();
  }
  bool contains(const Bounds& other) const
  {
    return (low.array() <= other.low.array()).all() && (other.high.array() <= high.array()).all();
  }
  bool is_finite() const { return low.allFinite() && high.allFinite(); }
  /// 0 where they overlap.
  double distance(const Bounds& other) const
  {
    return (other.low - high).cwiseMax(low - other.high).cwiseMax(0.0).norm();
  }
  void add(const Bounds& other)
  {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

Bounds bounds_of(const Geometry& shape, const Pose& pose);

/// The corner, edge or face of a shape's core that looks into a direction.
struct Feature
{
  static constexpr int most = 32;
  int count = 0;
  bool face = false; ///< A polygon, counterclockwise seen from outside, with a normal.
  bool round = false; ///< The polygon stands for a disc.
  std::uint32_t code = 0; ///< Which one.
  Vector normal = Vector::Zero();
  std::array<Vector, most> at;

  void add(const Vector& point) { at[static_cast<std::size_t>(count++)] = point; }
  const Vector& operator[](int i) const { return at[static_cast<std::size_t>(i)]; }
  void move(const Pose& pose);
};

/// With `slack`, the sine of the angle by which edges and faces may look elsewhere; discs get that many corners.
Feature feature_of(const Geometry& shape, const Vector& direction, double slack, int disc_corners);

} // namespace pydart2::native
