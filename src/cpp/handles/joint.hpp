#pragma once

#include <Eigen/Geometry>
#include <dart/dynamics/Joint.hpp>
#include <string>

#include "handles/part.hpp"

namespace pydart2 {

/// dart::dynamics::Joint of any type; what only some types have throws TypeError on the others.
class JointHandle
{
public:
  JointHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::Joint* joint);

  std::string name() const;
  std::string set_name(const std::string& name, bool rename_dofs);

  /// DART's class name, as "RevoluteJoint".
  std::string type() const;
  bool is_kinematic() const;
  bool is_dynamic() const;

  /// DART's name of the actuator type, as "FORCE".
  std::string actuator_type() const;
  void set_actuator_type(const std::string& type);

  /// Makes this joint follow another: q = multiplier * q_of_other + offset, with actuator type "MIMIC".
  void set_mimic(const JointHandle& other, double multiplier, double offset);

  /// Index in the skeleton of the joint that it follows, -1 for none.
  int mimic_joint() const;
  double mimic_multiplier() const;
  double mimic_offset() const;

  int num_dofs() const;
  int dof(long index) const;

  /// Indices in the skeleton; -1 for no parent.
  int parent_bodynode() const;
  int child_bodynode() const;

  Eigen::Matrix4d transform_from_parent_body_node() const;
  Eigen::Matrix4d transform_from_child_body_node() const;
  void set_transform_from_parent_body_node(const Eigen::Matrix4d& transform);
  void set_transform_from_child_body_node(const Eigen::Matrix4d& transform);

  /// Where its child is in its parent: q and the initial positions of a free joint; the pose of any other.
  void place(const Eigen::Matrix4d& pose);

  /// The joint's frame on the child's side and on the parent's side, in the world.
  Eigen::Matrix4d world_transform_of_child_side() const;
  Eigen::Matrix4d world_transform_of_parent_side() const;
  Eigen::Matrix4d relative_transform() const;

  bool is_position_limit_enforced() const;
  void set_position_limit_enforced(bool enforced);

  Eigen::Vector3d axis() const;
  void set_axis(const Eigen::Vector3d& axis);
  double pitch() const;
  void set_pitch(double pitch);
  /// Of a universal joint; of a planar and a two-dimensional translational one the directions of translation.
  Eigen::Vector3d axis1() const;
  void set_axis1(const Eigen::Vector3d& axis);
  Eigen::Vector3d axis2() const;
  void set_axis2(const Eigen::Vector3d& axis);

  /// "XYZ" or "ZYX".
  std::string axis_order() const;
  void set_axis_order(const std::string& order);

private:
  Part<dart::dynamics::Joint, dart::dynamics::JointPtr> joint_;
};

} // namespace pydart2
