#include "dynamics/free_bodies.hpp"

#include <cmath>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <typeinfo>

#include "engine/tree_members.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Entity;
using dart::dynamics::FreeJoint;
using dart::dynamics::Joint;
using dart::dynamics::Skeleton;
using Space = dart::math::SE3Space;
using Vector3 = FreeBodies::Vector3;
using Vector6 = FreeBodies::Vector6;

auto& state(FreeJoint& joint)
{
  return static_cast<dart::dynamics::GenericJoint<Space>&>(joint).*engine::GenericJointMembers<Space>::state;
}

/// Of a rotation vector.
Eigen::Quaterniond turn_of(const Vector3& vector)
{
  const double angle = vector.norm();
  const double scale = angle > 1e-8 ? std::sin(angle / 2.0) / angle : 0.5 - angle * angle / 48.0;
  return {std::cos(angle / 2.0), scale * vector.x(), scale * vector.y(), scale * vector.z()};
}

/// The rotation vector of at most pi.
Vector3 vector_of(const Eigen::Quaterniond& turn)
{
  const double sine = turn.vec().norm(), cosine = std::abs(turn.w());
  const double scale = sine > 1e-8 ? 2.0 * std::atan2(sine, cosine) / sine : 2.0;
  return (turn.w() < 0.0 ? -scale : scale) * turn.vec();
}

bool is_zero(const Vector6& value)
{
  return (value.array() == 0.0).all();
}

bool is_identity(const Eigen::Isometry3d& pose)
{
  return pose.matrix() == Eigen::Matrix4d::Identity();
}

/// Whether no dof is bounded, sprung, damped or braked.
bool is_plain(const FreeJoint& joint)
{
  const auto& terms = joint.dart::dynamics::GenericJoint<Space>::Base::getAspectProperties();
  const auto none = [](const auto& values) { return (values.array() == 0.0).all(); };
  const auto unbounded = [](const auto& lower, const auto& upper) {
    return (lower.array() == -INFINITY).all() && (upper.array() == INFINITY).all();
  };
  return none(terms.mDampingCoefficients) && none(terms.mSpringStiffnesses) && none(terms.mFrictions)
         && unbounded(terms.mPositionLowerLimits, terms.mPositionUpperLimits)
         && unbounded(terms.mVelocityLowerLimits, terms.mVelocityUpperLimits)
         && unbounded(terms.mAccelerationLowerLimits, terms.mAccelerationUpperLimits)
         && unbounded(terms.mForceLowerLimits, terms.mForceUpperLimits);
}

/// Lets the engine know that what it has found of a body is out of date.
void mark(FreeBodies::Body& body)
{
  using engine::BodyMembers;
  using engine::EntityMembers;
  using engine::JointMembers;
  BodyNode& node = *body.node;
  Entity& entity = node;
  const bool known = !(entity.*EntityMembers::transform_dirty && entity.*EntityMembers::velocity_dirty
                       && entity.*EntityMembers::acceleration_dirty && node.*BodyMembers::jacobian_dirty
                       && node.*BodyMembers::jacobian_rate_dirty && node.*BodyMembers::world_jacobian_rate_dirty);
  Joint& joint = *body.joint;
  joint.*JointMembers::transform_dirty = joint.*JointMembers::velocity_dirty = joint.*JointMembers::acceleration_dirty
      = joint.*JointMembers::primary_acceleration_dirty = joint.*JointMembers::jacobian_dirty
      = joint.*JointMembers::jacobian_rate_dirty = true;
  node.*BodyMembers::partial_acceleration_dirty = true;
  if (known) {
    node.dirtyTransform();
    (node.*BodyMembers::mark_jacobian)();
    (node.*BodyMembers::mark_jacobian_rate)();
  }
  const auto mark_all = [](auto& dirty) {
    dirty.mArticulatedInertia = dirty.mMassMatrix = dirty.mAugMassMatrix = dirty.mInvMassMatrix = dirty.mInvAugMassMatrix
        = dirty.mGravityForces = dirty.mExternalForces = dirty.mCoriolisForces = dirty.mCoriolisAndGravityForces = true;
  };
  auto& skeleton = *body.skeleton;
  mark_all(engine::SkeletonMembers::all(skeleton));
  mark_all(engine::SkeletonMembers::tree(skeleton, 0));
}

void place(FreeBodies::Body& body, const Eigen::Isometry3d& pose)
{
  body.pose = pose;
  body.pose.makeAffine();
  const auto turn = body.pose.linear();
  body.offset = turn * body.com;
  body.center = body.pose.translation() + body.offset;
  body.inverse_inertia.noalias() = turn * body.inverse_of_inertia * turn.transpose();
}

void find_velocity(FreeBodies::Body& body)
{
  body.velocity.head<3>() = body.angular;
  body.velocity.tail<3>() = body.linear + body.angular.cross(body.offset);
}

void read_state(FreeBodies::Body& body)
{
  const auto& from = state(*body.joint);
  body.turn = turn_of(from.mPositions.head<3>());
  Eigen::Isometry3d pose;
  pose.linear() = body.turn.toRotationMatrix();
  pose.translation() = from.mPositions.tail<3>();
  place(body, pose);
  const auto turn = body.pose.linear();
  body.angular = body.angular_before = turn * from.mVelocities.head<3>();
  body.linear = body.linear_before = turn * from.mVelocities.tail<3>();
  body.correction.setZero();
  body.command = from.mCommands;
}

void accelerate(FreeBodies::Body& body, const Vector3& gravity, double dt)
{
  const auto turn = body.pose.linear();
  const Vector3 spin = turn.transpose() * body.angular;
  Vector3 moment = -spin.cross(body.inertia * spin);
  Vector3 linear = body.weighs ? gravity : Vector3(Vector3::Zero());
  const Vector6& external = body.node->getExternalForceLocal();
  body.pushed = !is_zero(body.command) || !is_zero(external);
  if (body.pushed) {
    const Vector6 force = body.command + external;
    moment += force.head<3>() - body.com.cross(force.tail<3>());
    linear += body.inverse_mass * (turn * force.tail<3>());
  }
  const Vector3 angular = turn * (body.inverse_of_inertia * moment);
  linear -= angular.cross(body.offset) + body.angular.cross(body.angular.cross(body.offset)); // of the origin
  body.angular += dt * angular;
  body.linear += dt * linear;
  find_velocity(body);
}

} // namespace

bool FreeBodies::is_one(const Skeleton& skeleton)
{
  if (skeleton.getNumBodyNodes() != 1 || !skeleton.isMobile())
    return false;
  const auto& node = *skeleton.getBodyNode(0);
  const auto& joint = *skeleton.getJoint(0);
  return typeid(node) == typeid(BodyNode) && typeid(joint) == typeid(FreeJoint) && joint.getActuatorType() == Joint::FORCE
         && !joint.areLimitsEnforced() && is_identity(joint.getTransformFromParentBodyNode())
         && is_identity(joint.getTransformFromChildBodyNode()) && is_plain(static_cast<const FreeJoint&>(joint));
}

void FreeBodies::add(Skeleton& skeleton)
{
  Body body;
  body.skeleton = &skeleton;
  body.node = skeleton.getBodyNode(0);
  body.joint = static_cast<FreeJoint*>(skeleton.getJoint(0));
  read_model(body);
  places_.emplace(body.node, static_cast<int>(bodies_.size()));
  bodies_.push_back(body);
}

FreeBodies::Body FreeBodies::read(BodyNode& node)
{
  Body body;
  body.skeleton = node.getSkeleton().get();
  body.node = &node;
  body.joint = static_cast<FreeJoint*>(node.getParentJoint());
  read_model(body);
  const auto& velocity = node.getSpatialVelocity();
  place(body, node.getWorldTransform());
  body.angular = body.pose.linear() * velocity.head<3>();
  body.linear = body.pose.linear() * velocity.tail<3>();
  find_velocity(body);
  return body;
}

void FreeBodies::read_model(Body& body)
{
  const auto& inertia = body.node->getInertia();
  body.mass = inertia.getMass();
  body.inverse_mass = 1.0 / body.mass;
  body.com = inertia.getLocalCOM();
  body.inertia = inertia.getMoment();
  body.inverse_of_inertia = body.inertia.inverse();
  body.weighs = body.node->getGravityMode();
  body.reach = 0.0;
  for (std::size_t shape = 0; shape < body.node->getNumShapeNodes(); ++shape) {
    const auto& node = *body.node->getShapeNode(shape);
    const double far = node.getRelativeTransform().translation().cwiseAbs().sum();
    const double size = node.getShape()->is<dart::dynamics::PlaneShape>()
                            ? 0.0
                            : node.getShape()->getBoundingBox().computeFullExtents().sum();
    body.reach = std::max(body.reach, far + size);
  }
}

void FreeBodies::predict(const Vector3& gravity, double dt)
{
  for (auto& body : bodies_) {
    read_state(body);
    accelerate(body, gravity, dt);
  }
}

void FreeBodies::change(Body& body, const Vector6& change)
{
  const Vector3 turning = change.head<3>();
  body.angular += turning;
  body.linear += change.tail<3>() - turning.cross(body.offset);
}

void FreeBodies::integrate(double dt)
{
  for (auto& body : bodies_) {
    const Vector3 turning = body.correction.head<3>();
    body.turn = turn_of(dt * (body.angular + turning)) * body.turn;
    body.pose.translation() += dt * (body.linear + body.correction.tail<3>() - turning.cross(body.offset));
  }
}

void FreeBodies::give_back(double dt)
{
  const double rate = 1.0 / dt;
  for (auto& body : bodies_) {
    auto& to = state(*body.joint);
    to.mPositions.head<3>() = vector_of(body.turn);
    to.mPositions.tail<3>() = body.pose.translation();
    const Eigen::Matrix3d back = body.turn.normalized().toRotationMatrix().transpose();
    to.mVelocities.head<3>().noalias() = back * body.angular;
    to.mVelocities.tail<3>().noalias() = back * body.linear;
    // The engine's are spatial ones: without the turning of the velocity.
    to.mAccelerations.head<3>().noalias() = back * (rate * (body.angular - body.angular_before));
    to.mAccelerations.tail<3>().noalias()
        = back * (rate * (body.linear - body.linear_before) - body.angular.cross(body.linear));
    body.node->*engine::BodyMembers::force = body.command;
    if (body.pushed) {
      if (!is_zero(body.node->getExternalForceLocal()))
        body.node->clearExternalForces();
      to.mCommands.setZero();
    }
    to.mForces.setZero();
    mark(body);
  }
}

std::size_t FreeBodies::find_insane(double most) const
{
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto& body = bodies_[i];
    const double far = std::max(
        {body.pose.translation().cwiseAbs().maxCoeff(), body.angular.cwiseAbs().maxCoeff(), body.linear.cwiseAbs().maxCoeff()});
    // NaN is the largest of nothing
    const bool numbers = std::isfinite(body.pose.translation().sum() + body.angular.sum() + body.linear.sum());
    if (!(numbers && far <= most))
      return i;
  }
  return bodies_.size();
}

} // namespace pydart2
