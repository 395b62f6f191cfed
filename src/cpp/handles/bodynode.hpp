#pragma once

#include <Eigen/Geometry>
#include <dart/dynamics/BodyNode.hpp>
#include <string>

#include "base/arrays.hpp"
#include "handles/part.hpp"
#include "handles/shape.hpp"
#include "handles/soft_body.hpp"

namespace pydart2 {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// dart::dynamics::BodyNode. An offset is a point in the body frame, null for the body's origin. Jacobian rows are
/// angular, then linear; `full` gives a column to every dof of the skeleton, else to the dependent dofs only.
class BodyNodeHandle
{
public:
  BodyNodeHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::BodyNode* body);

  std::string name() const;
  int index_in_skeleton() const;
  int index_in_tree() const;
  int tree_index() const;

  /// Indices in the skeleton; -1 for no parent.
  int parent_bodynode() const;
  int num_child_bodynodes() const;
  int child_bodynode(long index) const;
  int parent_joint() const;
  int num_child_joints() const;
  int child_joint(long index) const;
  int num_dependent_dofs() const;
  int dependent_dof(long index) const;
  int num_shapenodes() const;
  ShapeNodeHandle shapenode(long index) const;

  /// Adds a shape of the engine's type with its sizes (built.hpp), or a mesh or field of heights; returns its index.
  /// It is drawn, takes part in contacts, both or neither.
  int add_shape(const std::string& type, const VectorIn& sizes, const std::string& name, bool visible, bool collides);
  int add_mesh(const MatrixIn& vertices, const MatrixIn& triangles, const std::string& name, bool visible, bool collides);
  int add_heightfield(const MatrixIn& heights, const Eigen::Vector3d& scale, const std::string& name, bool visible, bool collides);
  void remove_shape(long index);
  int add_marker(const std::string& name, const Eigen::Vector3d& position);
  bool is_soft() const;
  SoftBodyHandle soft_body() const;

  bool gravity_mode() const;
  void set_gravity_mode(bool enable);
  bool is_collidable() const;
  void set_collidable(bool enable);

  double mass() const;
  void set_mass(double mass);
  Eigen::Vector3d local_com() const;
  void set_local_com(const Eigen::Vector3d& com);

  /// Adds the mass of a part of the body, whose moment of inertia is about its own COM, body axes.
  void add_mass(double mass, const Eigen::Vector3d& com, const Eigen::Matrix3d& inertia);

  /// About the COM, body axes.
  Eigen::Matrix3d inertia() const;
  void set_inertia(const Eigen::Matrix3d& inertia);

  /// Of the first shape that takes part in contacts; setting changes all of them.
  double friction_coeff() const;
  double restitution_coeff() const;
  /// False if the body has no such shape.
  bool set_friction_coeff(double coefficient);
  bool set_restitution_coeff(double coefficient);

  void transform(Output& into) const;
  Eigen::Matrix4d relative_transform() const;
  Eigen::Vector3d to_world(const Eigen::Vector3d* offset) const;
  Eigen::Vector3d to_local(const Eigen::Vector3d& point) const;

  Eigen::Vector3d com() const;
  Eigen::Vector3d com_linear_velocity() const;
  Eigen::Vector3d com_linear_acceleration() const;
  Vector6d com_spatial_velocity() const;
  Vector6d com_spatial_acceleration() const;

  /// Of a point of the body, or of the body; world frame. Spatial: angular, then linear.
  Eigen::Vector3d linear_velocity(const Eigen::Vector3d* offset) const;
  Eigen::Vector3d linear_acceleration(const Eigen::Vector3d* offset) const;
  Eigen::Vector3d angular_velocity() const;
  Eigen::Vector3d angular_acceleration() const;
  Vector6d spatial_velocity(const Eigen::Vector3d* offset) const;
  Vector6d spatial_acceleration(const Eigen::Vector3d* offset) const;
  Eigen::Vector3d linear_momentum() const;
  Eigen::Vector3d angular_momentum() const;

  void add_ext_force(const Eigen::Vector3d& force, const Eigen::Vector3d& offset, bool force_local, bool offset_local);
  void set_ext_force(const Eigen::Vector3d& force, const Eigen::Vector3d& offset, bool force_local, bool offset_local);
  void add_ext_torque(const Eigen::Vector3d& torque, bool local);
  void set_ext_torque(const Eigen::Vector3d& torque, bool local);

  void jacobian(const Eigen::Vector3d* offset, bool full, Output& into) const;
  void world_jacobian(const Eigen::Vector3d* offset, bool full, Output& into) const;
  void linear_jacobian(const Eigen::Vector3d* offset, bool full, Output& into) const;
  void angular_jacobian(bool full, Output& into) const;
  void world_jacobian_classic_deriv(const Eigen::Vector3d* offset, bool full, Output& into) const;
  void linear_jacobian_deriv(const Eigen::Vector3d* offset, bool full, Output& into) const;
  void angular_jacobian_deriv(bool full, Output& into) const;

  /// For the C++ of this layer.
  dart::dynamics::BodyNode& body() const { return *body_; }

private:
  /// The body with its pose, or pose and velocity, up to date.
  dart::dynamics::BodyNode& posed() const;
  dart::dynamics::BodyNode& moving() const;

  template <class Columns>
  void write(const dart::dynamics::BodyNode& body, const Columns& dependent, bool full, Output& out) const;

  Part<dart::dynamics::BodyNode, dart::dynamics::BodyNodePtr> body_;
};

} // namespace pydart2
