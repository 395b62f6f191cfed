#include "handles/joint.hpp"

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/EulerJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/ScrewJoint.hpp>
#include <dart/dynamics/TranslationalJoint2D.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <utility>

#include "base/checks.hpp"

namespace pydart2 {

using dart::dynamics::BodyNode;
using dart::dynamics::EulerJoint;
using dart::dynamics::Joint;
using dart::dynamics::PlanarJoint;
using dart::dynamics::PrismaticJoint;
using dart::dynamics::RevoluteJoint;
using dart::dynamics::ScrewJoint;
using dart::dynamics::TranslationalJoint2D;
using dart::dynamics::UniversalJoint;

namespace {

constexpr std::pair<Joint::ActuatorType, const char*> actuators[] = {
    {Joint::FORCE, "FORCE"},
    {Joint::PASSIVE, "PASSIVE"},
    {Joint::SERVO, "SERVO"},
    {Joint::MIMIC, "MIMIC"},
    {Joint::ACCELERATION, "ACCELERATION"},
    {Joint::VELOCITY, "VELOCITY"},
    {Joint::LOCKED, "LOCKED"},
};

/// The engine does not see that the articulated inertia is another one until the robot moves. In M^-1 it goes on with what it
/// has last formed of a joint whose motion is prescribed from then on: that of now.
void use_actuator(Joint& joint, Joint::ActuatorType type)
{
  joint.getChildBodyNode()->getArticulatedInertia();
  joint.setActuatorType(type);
  joint.getChildBodyNode()->dirtyArticulatedInertia();
}

[[noreturn]] void wrong_type(const Joint& joint, const char* asked)
{
  throw Error(Kind::type, "joint '" + joint.getName() + "' is a " + joint.getType() + " and has no " + asked);
}

template <class Type>
Type& as(Joint& joint, const char* asked)
{
  if (auto* cast = dynamic_cast<Type*>(&joint))
    return *cast;
  wrong_type(joint, asked);
}

Eigen::Isometry3d isometry(const Eigen::Matrix4d& matrix, const char* what)
{
  check::rigid(matrix, what);
  Eigen::Isometry3d transform;
  transform.matrix() = matrix;
  return transform;
}

} // namespace

JointHandle::JointHandle(WorldRef world, SkeletonRef skeleton, Joint* joint)
  : joint_(std::move(world), std::move(skeleton), joint)
{
}

std::string JointHandle::name() const
{
  return joint_->getName();
}

std::string JointHandle::set_name(const std::string& name, bool rename_dofs)
{
  return joint_->setName(name, rename_dofs);
}

std::string JointHandle::type() const
{
  return joint_->getType();
}

bool JointHandle::is_kinematic() const
{
  return joint_->isKinematic();
}

bool JointHandle::is_dynamic() const
{
  return joint_->isDynamic();
}

std::string JointHandle::actuator_type() const
{
  const auto type = joint_->getActuatorType();
  for (const auto& [value, name] : actuators)
    if (value == type)
      return name;
  throw Error(Kind::engine, "joint '" + name() + "' has an actuator type that is not known here");
}

void JointHandle::set_actuator_type(const std::string& type)
{
  if (type == "MIMIC" && joint_->getMimicJoint() == nullptr)
    throw Error(Kind::value, "joint '" + name() + "' follows no joint yet; use set_mimic(joint, multiplier, offset)");
  for (const auto& [value, name] : actuators)
    if (name == type) {
      use_actuator(*joint_, value);
      joint_.skeleton->limits_checked = false;
      return;
    }
  throw Error(Kind::value, "no actuator type '" + type + "'");
}

void JointHandle::set_mimic(const JointHandle& other, double multiplier, double offset)
{
  check::finite(multiplier, "mimic multiplier");
  check::finite(offset, "mimic offset");
  if (other.joint_.get() == joint_.get() || other.joint_.skeleton != joint_.skeleton)
    throw Error(Kind::value, "joint '" + name() + "' can follow another joint of the same skeleton only");
  if (other.num_dofs() != num_dofs())
    throw Error(Kind::value, "joint '" + name() + "' can follow a joint with as many dofs only");
  joint_->setMimicJoint(other.joint_.get(), multiplier, offset);
  use_actuator(*joint_, Joint::MIMIC);
  joint_.skeleton->limits_checked = false;
}

int JointHandle::mimic_joint() const
{
  const Joint* other = joint_->getMimicJoint();
  return other == nullptr ? -1 : static_cast<int>(other->getJointIndexInSkeleton());
}

double JointHandle::mimic_multiplier() const
{
  return joint_->getMimicMultiplier();
}

double JointHandle::mimic_offset() const
{
  return joint_->getMimicOffset();
}

int JointHandle::num_dofs() const
{
  return static_cast<int>(joint_->getNumDofs());
}

int JointHandle::dof(long index) const
{
  const auto i = check::index(index, joint_->getNumDofs(), "dof of joint");
  return static_cast<int>(joint_->getDof(i)->getIndexInSkeleton());
}

int JointHandle::parent_bodynode() const
{
  const BodyNode* parent = joint_->getParentBodyNode();
  return parent == nullptr ? -1 : static_cast<int>(parent->getIndexInSkeleton());
}

int JointHandle::child_bodynode() const
{
  return static_cast<int>(joint_->getChildBodyNode()->getIndexInSkeleton());
}

Eigen::Matrix4d JointHandle::transform_from_parent_body_node() const
{
  return joint_->getTransformFromParentBodyNode().matrix();
}

Eigen::Matrix4d JointHandle::transform_from_child_body_node() const
{
  return joint_->getTransformFromChildBodyNode().matrix();
}

void JointHandle::set_transform_from_parent_body_node(const Eigen::Matrix4d& transform)
{
  joint_->setTransformFromParentBodyNode(isometry(transform, "transform from the parent body"));
}

void JointHandle::set_transform_from_child_body_node(const Eigen::Matrix4d& transform)
{
  joint_->setTransformFromChildBodyNode(isometry(transform, "transform from the child body"));
}

void JointHandle::place(const Eigen::Matrix4d& pose)
{
  const auto transform = isometry(pose, "pose");
  if (auto* free = dynamic_cast<dart::dynamics::FreeJoint*>(joint_.get())) {
    const auto inner = free->getTransformFromParentBodyNode().inverse() * transform * free->getTransformFromChildBodyNode();
    const Eigen::VectorXd q = dart::dynamics::FreeJoint::convertToPositions(inner);
    free->setPositions(q);
    free->setInitialPositions(q);
  } else {
    const auto motion = joint_->getTransformFromParentBodyNode().inverse() * joint_->getRelativeTransform();
    joint_->setTransformFromParentBodyNode(transform * motion.inverse());
  }
}

Eigen::Matrix4d JointHandle::world_transform_of_child_side() const
{
  return (joint_->getChildBodyNode()->getWorldTransform() * joint_->getTransformFromChildBodyNode()).matrix();
}

Eigen::Matrix4d JointHandle::world_transform_of_parent_side() const
{
  const BodyNode* parent = joint_->getParentBodyNode();
  const auto& T = joint_->getTransformFromParentBodyNode();
  return parent == nullptr ? T.matrix() : (parent->getWorldTransform() * T).matrix();
}

Eigen::Matrix4d JointHandle::relative_transform() const
{
  return joint_->getRelativeTransform().matrix();
}

bool JointHandle::is_position_limit_enforced() const
{
  return joint_->areLimitsEnforced();
}

void JointHandle::set_position_limit_enforced(bool enforced)
{
  joint_->setLimitEnforcement(enforced);
  joint_.skeleton->limits_checked = false;
}

Eigen::Vector3d JointHandle::axis() const
{
  Joint& joint = *joint_;
  if (auto* revolute = dynamic_cast<RevoluteJoint*>(&joint))
    return revolute->getAxis();
  if (auto* prismatic = dynamic_cast<PrismaticJoint*>(&joint))
    return prismatic->getAxis();
  return as<ScrewJoint>(joint, "axis").getAxis();
}

void JointHandle::set_axis(const Eigen::Vector3d& axis)
{
  check::direction(axis, "joint axis");
  Joint& joint = *joint_;
  if (auto* revolute = dynamic_cast<RevoluteJoint*>(&joint))
    revolute->setAxis(axis);
  else if (auto* prismatic = dynamic_cast<PrismaticJoint*>(&joint))
    prismatic->setAxis(axis);
  else
    as<ScrewJoint>(joint, "axis").setAxis(axis);
}

double JointHandle::pitch() const
{
  return as<ScrewJoint>(*joint_, "pitch").getPitch();
}

void JointHandle::set_pitch(double pitch)
{
  check::finite(pitch, "pitch");
  as<ScrewJoint>(*joint_, "pitch").setPitch(pitch);
}

Eigen::Vector3d JointHandle::axis1() const
{
  Joint& joint = *joint_;
  if (auto* planar = dynamic_cast<PlanarJoint*>(&joint))
    return planar->getTranslationalAxis1();
  if (auto* plane = dynamic_cast<TranslationalJoint2D*>(&joint))
    return plane->getTranslationalAxis1();
  return as<UniversalJoint>(joint, "axis1").getAxis1();
}

void JointHandle::set_axis1(const Eigen::Vector3d& axis)
{
  check::direction(axis, "joint axis 1");
  as<UniversalJoint>(*joint_, "axis1").setAxis1(axis.normalized()); // the engine takes any length
}

Eigen::Vector3d JointHandle::axis2() const
{
  Joint& joint = *joint_;
  if (auto* planar = dynamic_cast<PlanarJoint*>(&joint))
    return planar->getTranslationalAxis2();
  if (auto* plane = dynamic_cast<TranslationalJoint2D*>(&joint))
    return plane->getTranslationalAxis2();
  return as<UniversalJoint>(joint, "axis2").getAxis2();
}

void JointHandle::set_axis2(const Eigen::Vector3d& axis)
{
  check::direction(axis, "joint axis 2");
  as<UniversalJoint>(*joint_, "axis2").setAxis2(axis.normalized());
}

std::string JointHandle::axis_order() const
{
  return as<EulerJoint>(*joint_, "axis order").getAxisOrder() == EulerJoint::AxisOrder::XYZ ? "XYZ" : "ZYX";
}

void JointHandle::set_axis_order(const std::string& order)
{
  auto& joint = as<EulerJoint>(*joint_, "axis order");
  if (order != "XYZ" && order != "ZYX")
    throw Error(Kind::value, "the axis order is 'XYZ' or 'ZYX', got '" + order + "'");
  // The engine renames one dof after another and evades names that are still taken: free them first.
  for (std::size_t i = 0; i < joint.getNumDofs(); ++i)
    if (!joint.getDof(i)->isNamePreserved())
      joint.getDof(i)->setName(joint.getName() + " dof " + std::to_string(i), false);
  joint.setAxisOrder(order == "XYZ" ? EulerJoint::AxisOrder::XYZ : EulerJoint::AxisOrder::ZYX);
}

} // namespace pydart2
