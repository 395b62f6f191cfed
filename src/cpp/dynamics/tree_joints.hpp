#pragma once

#include <dart/dynamics/GenericJoint.hpp>

#include "base/fetch.hpp"
#include "dynamics/tree_dynamics.hpp"
#include "engine/tree_members.hpp"

/// What the files of TreeDynamics share: the engine's numbers of a joint and its body, read and written in place.
namespace pydart2::tree {

using namespace dart::dynamics;
using Body = engine::BodyMembers;
using FrameOf = engine::FrameMembers;
using EntityOf = engine::EntityMembers;
using JointOf = engine::JointMembers;
template <class Space>
using Generic = engine::GenericJointMembers<Space>;

using Vector6 = TreeDynamics::Vector6;
using Matrix6 = TreeDynamics::Matrix6;

template <class Space>
const auto& properties(const GenericJoint<Space>& joint)
{
  return joint.GenericJoint<Space>::Base::getAspectProperties();
}

template <class Space>
auto& state(GenericJoint<Space>& joint)
{
  return joint.*Generic<Space>::state;
}

/// The Jacobian of a joint, brought up to date by the engine if it changes with the positions.
template <class Space>
const auto& jacobian(const GenericJoint<Space>& joint, bool constant)
{
  if (!constant && joint.*JointOf::jacobian_dirty)
    joint.getRelativeJacobianStatic();
  return joint.*Generic<Space>::jacobian;
}

template <class Space>
const auto& jacobian_rate(const GenericJoint<Space>& joint, bool constant)
{
  if (!constant && joint.*JointOf::jacobian_rate_dirty)
    joint.getRelativeJacobianTimeDerivStatic();
  return joint.*Generic<Space>::jacobian_rate;
}

inline Joint::ActuatorType actuator(const Joint& joint)
{
  return (joint.*JointOf::properties).mActuatorType;
}

/// As Joint::isKinematic().
inline bool is_kinematic(const Joint& joint)
{
  const auto type = actuator(joint);
  return type == Joint::ACCELERATION || type == Joint::VELOCITY || type == Joint::LOCKED;
}

/// As the engine sets a state: what is equal stays, its zeros with their signs. Whether it has changed.
template <class Vector>
bool assign(Vector& place, const Vector& value)
{
  if (place == value)
    return false;
  place = value;
  return true;
}

/// Whether nobody is to be told when an entity is out of date.
inline bool is_unheard(const Entity& entity)
{
  return (entity.*EntityOf::transform_signal).getNumConnections() == 0
         && (entity.*EntityOf::velocity_signal).getNumConnections() == 0
         && (entity.*EntityOf::acceleration_signal).getNumConnections() == 0;
}

template <class Joint>
struct SpaceOfJoint;
template <class Space>
struct SpaceOfJoint<GenericJoint<Space>&>
{
  using type = Space;
};
/// The configuration space of a GenericJoint.
template <class Joint>
using SpaceOf = typename SpaceOfJoint<Joint>::type;

} // namespace pydart2::tree

namespace pydart2 {

/// Calls `visit` with the joint as the GenericJoint that it is; not for one without dofs.
template <class Visit>
[[gnu::always_inline]] inline void TreeDynamics::visit(const Link& link, Visit&& visit)
{
  using namespace dart::math;
  using dart::dynamics::GenericJoint;
  switch (link.kind) {
  case Kind::none:
    break;
  case Kind::r1:
    visit(static_cast<GenericJoint<R1Space>&>(*link.joint));
    break;
  case Kind::r2:
    visit(static_cast<GenericJoint<R2Space>&>(*link.joint));
    break;
  case Kind::r3:
    visit(static_cast<GenericJoint<R3Space>&>(*link.joint));
    break;
  case Kind::so3:
    visit(static_cast<GenericJoint<SO3Space>&>(*link.joint));
    break;
  case Kind::se3:
    visit(static_cast<GenericJoint<SE3Space>&>(*link.joint));
    break;
  }
}

} // namespace pydart2
