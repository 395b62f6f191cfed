#pragma once

#include <Eigen/Geometry>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Shape.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <string>

#include "base/arrays.hpp"
#include "handles/part.hpp"

namespace pydart2 {

class MeshHandle;

/// The geometry of a shape node. What only some kinds have throws TypeError on the others; lengths in metres.
class ShapeHandle
{
public:
  using Node = Part<dart::dynamics::ShapeNode, NodeOwner<dart::dynamics::ShapeNode>>;

  explicit ShapeHandle(const Node& node);

  /// DART's class name, as "BoxShape".
  std::string type() const;

  /// Of the shape among all shapes of the process, and how often its data has changed.
  long id() const;
  long version() const;

  double volume() const;
  Eigen::Vector3d bounding_box_min() const;
  Eigen::Vector3d bounding_box_max() const;

  /// Sphere, cylinder, capsule, cone.
  double radius() const;
  void set_radius(double radius);

  /// Cylinder, capsule (without the caps), cone, pyramid.
  double height() const;
  void set_height(double height);

  /// Box (edges), ellipsoid (diameters).
  Eigen::Vector3d size() const;
  void set_size(const Eigen::Vector3d& size);

  /// Pyramid.
  double base_width() const;
  void set_base_width(double width);
  double base_depth() const;
  void set_base_depth(double depth);

  /// Plane: normal . x = offset.
  Eigen::Vector3d normal() const;
  void set_normal(const Eigen::Vector3d& normal);
  double offset() const;
  void set_offset(double offset);

  /// Convex hull of spheres; rows [radius, x, y, z].
  int num_spheres() const;
  void spheres(Output& out) const;
  void add_sphere(double radius, const Eigen::Vector3d& position);

  /// Mesh, heightmap.
  Eigen::Vector3d scale() const;
  /// Mesh: the file that it came from.
  std::string path() const;
  /// Mesh: the axes along which the file was mirrored, as "xz"; empty for none (shared_scenes.hpp).
  std::string mirrored() const;
  /// Mesh, arrow: the meshes in the file, and whether their materials give the colours.
  int num_meshes() const;
  MeshHandle mesh(long index) const;
  bool uses_materials() const;

  /// Heightmap: heights above the shape's xy plane, not scaled; row 0 at the greatest y, column 0 at the least x.
  void heights(Output& out) const;

  /// Line segments: both ends of each, a row of six numbers; width in pixels.
  void segments(Output& out) const;
  double thickness() const;

  /// Point cloud: positions; colours (no rows if all have the shape's own); edge or diameter of what marks a point.
  void points(Output& out) const;
  void point_colors(Output& out) const;
  double point_size() const;

  /// Voxel grid: centre and edge of each occupied cell, rows of four numbers.
  void voxels(Output& out) const;

private:
  dart::dynamics::Shape& shape() const;
  dart::dynamics::Shape& shape(); ///< To change it.

  Node node_;
};

/// dart::dynamics::ShapeNode: where a shape sits on its body, and what it is for.
class ShapeNodeHandle
{
public:
  ShapeNodeHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::ShapeNode* node);

  std::string name() const;
  bool has_shape() const;
  ShapeHandle shape() const;
  bool has_visual_aspect() const;
  bool has_collision_aspect() const;
  bool has_dynamics_aspect() const;
  Eigen::Vector4d rgba() const;
  void set_rgba(const Eigen::Vector4d& rgba);
  bool is_hidden() const;
  Eigen::Vector3d offset() const;
  void set_offset(const Eigen::Vector3d& offset);
  Eigen::Matrix4d relative_transform() const;
  void set_relative_transform(const Eigen::Matrix4d& transform);
  Eigen::Matrix4d world_transform() const;

  /// Of one that takes part in contacts; ValueError otherwise.
  void set_friction_coeff(double coefficient);
  double restitution_coeff() const;
  void set_restitution_coeff(double coefficient);
  /// Friction coefficients along the first direction and across it, then slip compliances likewise, m/(N s).
  Eigen::Vector4d tangential_coeffs() const;
  void set_tangential_coeffs(const Eigen::Vector4d& coefficients);
  /// The first direction, in the shape's frame; zero for one that the engine chooses for each contact.
  Eigen::Vector3d friction_direction() const;
  void set_friction_direction(const Eigen::Vector3d& direction);

private:
  dart::dynamics::DynamicsAspect& dynamics() const;
  dart::dynamics::DynamicsAspect& dynamics(); ///< To change it.

  ShapeHandle::Node node_;
};

} // namespace pydart2
