#include "dynamics/tree_dynamics.hpp"

#include <algorithm>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/EulerJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/ScrewJoint.hpp>
#include <dart/dynamics/TranslationalJoint.hpp>
#include <dart/dynamics/TranslationalJoint2D.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <typeinfo>

#include "dynamics/inverse_inertia.hpp"
#include "dynamics/spatial_inline.hpp"
#include "dynamics/tree_joints.hpp"

namespace pydart2 {

using namespace tree;

namespace {

/// To a joint's projected inertia; whether there are any.
template <class Space>
bool add_implicit_terms(const GenericJoint<Space>& joint, double dt, typename Space::Matrix& projected)
{
  const auto& terms = properties(joint);
  const bool any = (terms.mDampingCoefficients.array() != 0.0).any() || (terms.mSpringStiffnesses.array() != 0.0).any();
  if (any)
    projected += (dt * terms.mDampingCoefficients + dt * dt * terms.mSpringStiffnesses).asDiagonal();
  return any;
}

/// Once for all kinds of joints, so that what a step runs through stays in the processor's cache of instructions.
[[gnu::noinline]] void add_inertia_to_parent(const Eigen::Isometry3d& T, const Matrix6& inertia, Matrix6& sum)
{
  sum += spatial::inertia_to_parent(T, inertia);
}

} // namespace

std::unique_ptr<TreeDynamics> TreeDynamics::of(Skeleton& skeleton)
{
  if (skeleton.getNumSoftBodyNodes() > 0)
    return nullptr;
  std::unique_ptr<TreeDynamics> made(new TreeDynamics(skeleton));
  for (std::size_t tree = 0; tree < skeleton.getNumTrees(); ++tree)
    if (!made->add(*skeleton.getRootBodyNode(tree), nullptr))
      return nullptr;
  made->look();
  return made;
}

TreeDynamics::TreeDynamics(Skeleton& skeleton) : skeleton_(skeleton), by_body_(skeleton.getNumBodyNodes()) {}

bool TreeDynamics::add(BodyNode& body, Link* parent)
{
  Joint& joint = *body.getParentJoint();
  auto made = std::make_unique<Link>();
  Link& link = *made;
  link.body = &body;
  link.joint = &joint;
  link.frame = &body;
  link.entity = &body;
  link.parent_frame = body.getParentFrame();
  link.parent = parent;
  link.tree = body.getTreeIndex();
  link.inertia = &body.getSpatialInertia();
  link.external_force = &body.getExternalForceLocal();
  link.articulated = &(body.*Body::inertia);
  link.articulated_implicit = &(body.*Body::inertia_implicit);
  link.transform = &(joint.*JointOf::transform);
  link.partial_acceleration = &(body.*Body::partial_acceleration);
  link.bias_force = &(body.*Body::bias_force);

  const auto& type = typeid(joint);
  if (type == typeid(RevoluteJoint))
    link.axis = &static_cast<RevoluteJoint&>(joint).getAxis();
  if (type == typeid(UniversalJoint))
    link.universal = static_cast<UniversalJoint*>(&joint);
  if (type == typeid(RevoluteJoint) || type == typeid(PrismaticJoint) || type == typeid(ScrewJoint))
    link.kind = Kind::r1;
  else if (type == typeid(UniversalJoint) || type == typeid(TranslationalJoint2D))
    link.kind = Kind::r2;
  else if (type == typeid(EulerJoint) || type == typeid(PlanarJoint) || type == typeid(TranslationalJoint))
    link.kind = Kind::r3;
  else if (type == typeid(BallJoint))
    link.kind = Kind::so3;
  else if (type == typeid(FreeJoint))
    link.kind = Kind::se3;
  else if (type != typeid(WeldJoint))
    return false;
  if (typeid(body) != typeid(BodyNode))
    return false;
  link.constant = type != typeid(UniversalJoint) && type != typeid(EulerJoint) && type != typeid(PlanarJoint);

  links_.push_back(std::move(made));
  by_body_[body.getIndexInSkeleton()] = &link;
  if (parent != nullptr)
    parent->children.push_back(&link);
  for (std::size_t i = 0; i < body.getNumChildBodyNodes(); ++i)
    if (!add(*body.getChildBodyNode(i), &link))
      return false;
  return true;
}

bool TreeDynamics::moves_on() const
{
  bool stale = moved_ && !pushed_off_;
  for (std::size_t tree = 0; tree < skeleton_.getNumTrees() && stale; ++tree)
    stale = engine::SkeletonMembers::tree(skeleton_, tree).mArticulatedInertia;
  return stale;
}

void TreeDynamics::put_numbers(Numbers* shared)
{
  if (shared == shared_)
    return;
  shared_ = shared;
  for (auto& link : links_) {
    BodyNode& body = *link->body;
    link->articulated_implicit = shared == nullptr ? &(body.*Body::inertia_implicit) : &shared->inertia_implicit;
    link->transform = shared == nullptr ? &(link->joint->*JointOf::transform) : &shared->transform;
    link->partial_acceleration = shared == nullptr ? &(body.*Body::partial_acceleration) : &shared->partial_acceleration;
    link->bias_force = shared == nullptr ? &(body.*Body::bias_force) : &shared->bias_force;
    if (shared != nullptr)
      ++shared;
  }
}

bool TreeDynamics::is_for_engine() const
{
  for (const auto& link : links_)
    if (actuator(*link->joint) == Joint::LOCKED) {
      bool moves = false;
      visit(*link, [&](auto& joint) { moves = (state(joint).mVelocities.array() != 0.0).any(); });
      if (moves)
        return true;
    }
  return false;
}

bool TreeDynamics::is_within(double distance) const
{
  return std::all_of(links_.begin(), links_.end(), [distance](const auto& link) {
    return ((link->frame->*FrameOf::transform).translation().array().abs() <= distance).all(); // not NaN
  });
}

void TreeDynamics::fetch_numbers(std::size_t i) const
{
  if (!fetch_ahead_ || i >= links_.size())
    return;
  const Link& link = *links_[i];
  fetch(*link.external_force);
  fetch(*link.inertia, *link.inertia);
  if (shared_ == nullptr)
    fetch(link.body->*Body::partial_acceleration, link.body->*Body::bias_force);
  else
    fetch(link.body->*Body::force);
  fetch(link.frame->*FrameOf::transform, link.frame->*FrameOf::acceleration);
  fetch(link.joint->*JointOf::properties, link.joint->*JointOf::transform_dirty);
  fetch_flags(i);
}

void TreeDynamics::accelerate(bool may_leave)
{
  const double dt = skeleton_.getTimeStep();
  const Eigen::Vector3d gravity = skeleton_.getGravity();
  thread_local std::vector<Numbers> numbers;
  if (numbers.size() < links_.size())
    numbers.resize(links_.size());
  const bool leave = may_leave && moves_on();
  put_numbers(leave && fetch_ahead_ ? numbers.data() : nullptr);
  pushed_off_ = false;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    fetch_numbers(i + 1);
    auto& link = *links_[i];
    link.kinematic = is_kinematic(*link.joint);
    update_motion(link);
  }
  update_inertias(leave);
  for (auto link = links_.rbegin(); link != links_.rend(); ++link)
    update_bias_force(**link, gravity, dt);
  mark_accelerations();
  for (auto& link : links_)
    update_acceleration(*link, dt);
}

void TreeDynamics::find_pose(const BodyNode& body)
{
  put_numbers(nullptr);
  find_pose(*by_body_[body.getIndexInSkeleton()]);
}

void TreeDynamics::find_velocity(const BodyNode& body)
{
  put_numbers(nullptr);
  find_velocity(*by_body_[body.getIndexInSkeleton()]);
}

void TreeDynamics::find_pose(Link& link)
{
  if (!(link.entity->*EntityOf::transform_dirty))
    return;
  if (link.parent != nullptr)
    find_pose(*link.parent);
  update_transform(link);
  update_pose(link);
}

void TreeDynamics::find_velocity(Link& link)
{
  if (!(link.entity->*EntityOf::velocity_dirty))
    return;
  if (link.parent != nullptr)
    find_velocity(*link.parent);
  update_transform(link);
  update_velocity(link);
}

/// Poses and velocities, and the acceleration that comes of them alone.
[[gnu::flatten]] void TreeDynamics::update_motion(Link& link)
{
  update_transform(link);
  if (link.universal != nullptr)
    update_universal(*link.universal);
  update_pose(link);
  link.unread = link.entity->*EntityOf::velocity_dirty;
  update_velocity(link);
  if (shared_ == nullptr && !(link.body->*Body::partial_acceleration_dirty))
    return;
  if (link.kind == Kind::none)
    link.partial_acceleration->setZero();
  visit(link, [&](auto& typed) {
    const Vector6 relative = jacobian(typed, link.constant) * state(typed).mVelocities;
    *link.partial_acceleration = spatial::cross(link.frame->*FrameOf::velocity, relative)
                                 + jacobian_rate(typed, link.constant) * state(typed).mVelocities;
  });
  if (shared_ == nullptr)
    link.body->*Body::partial_acceleration_dirty = false;
}

/// From the parent's and the joint's.
[[gnu::flatten]] void TreeDynamics::update_pose(Link& link)
{
  if (!(link.entity->*EntityOf::transform_dirty))
    return;
  link.frame->*FrameOf::transform = link.parent_frame->*FrameOf::transform * *link.transform;
  link.entity->*EntityOf::transform_dirty = false;
}

/// From the parent's and the joint's.
[[gnu::flatten]] void TreeDynamics::update_velocity(Link& link)
{
  if (!(link.entity->*EntityOf::velocity_dirty))
    return;
  Joint& joint = *link.joint;
  Vector6 relative = joint.*JointOf::velocity;
  if (joint.*JointOf::velocity_dirty) {
    visit(link, [&](auto& typed) { relative = jacobian(typed, link.constant) * state(typed).mVelocities; });
    if (shared_ == nullptr) {
      joint.*JointOf::velocity = relative;
      joint.*JointOf::velocity_dirty = false;
    }
  }
  link.frame->*FrameOf::velocity = spatial::to_child(*link.transform, link.parent_frame->*FrameOf::velocity) + relative;
  link.entity->*EntityOf::velocity_dirty = false;
}

/// Of the joint.
[[gnu::flatten]] void TreeDynamics::update_transform(Link& link)
{
  Joint& joint = *link.joint;
  const auto put = [&](const Eigen::Isometry3d& moved) {
    *link.transform = joint.getTransformFromParentBodyNode() * moved * joint.getTransformFromChildBodyNode().inverse();
    joint.*JointOf::transform_dirty = shared_ != nullptr;
  };
  if (joint.*JointOf::transform_dirty && link.axis != nullptr) {
    put(spatial::turn(*link.axis * static_cast<RevoluteJoint&>(joint).getPositionsStatic()));
    return;
  }
  if (joint.*JointOf::transform_dirty && link.kind == Kind::so3) {
    auto& ball = static_cast<BallJoint&>(joint);
    Eigen::Isometry3d& turned = ball.*engine::BallJointMembers::turned;
    turned.linear() = spatial::rotation(ball.getPositionsStatic());
    put(turned);
    return;
  }
  if (joint.*JointOf::transform_dirty && link.kind == Kind::se3) {
    auto& free = static_cast<FreeJoint&>(joint);
    put(free.*engine::FreeJointMembers::moved = spatial::placement(free.getPositionsStatic()));
    return;
  }
  if (joint.*JointOf::transform_dirty && link.universal != nullptr) {
    const auto& universal = *link.universal;
    const auto& q = universal.getPositionsStatic();
    *link.transform = joint.getTransformFromParentBodyNode() * Eigen::AngleAxisd(q[0], universal.getAxis1())
                      * Eigen::AngleAxisd(q[1], universal.getAxis2()) * joint.getTransformFromChildBodyNode().inverse();
    joint.*JointOf::transform_dirty = shared_ != nullptr;
    return;
  }
  const auto& T = joint.getRelativeTransform();
  if (shared_ != nullptr)
    *link.transform = T;
}

/// Its Jacobian and the rate of that, as the engine's UniversalJoint forms them.
[[gnu::flatten]] void TreeDynamics::update_universal(UniversalJoint& joint)
{
  if (!(joint.*JointOf::jacobian_dirty || joint.*JointOf::jacobian_rate_dirty))
    return;
  const Eigen::Isometry3d& T = joint.getTransformFromChildBodyNode();
  auto& J = joint.*Generic<dart::math::R2Space>::jacobian;
  J.col(0) = spatial::from_turning(T * spatial::turn(-joint.getAxis2() * joint.getPositionsStatic()[1]), joint.getAxis1());
  J.col(1) = spatial::from_turning(T, joint.getAxis2());
  const Vector6 along = J.col(1) * joint.getVelocitiesStatic()[1];
  (joint.*Generic<dart::math::R2Space>::jacobian_rate).col(0) = -spatial::cross(along, J.col(0));
  joint.*JointOf::jacobian_dirty = joint.*JointOf::jacobian_rate_dirty = false;
}

/// The articulated inertias of the trees in which they are out of date.
void TreeDynamics::update_inertias(bool only_implicit)
{
  const double dt = skeleton_.getTimeStep();
  const auto update = only_implicit ? update_implicit_inertia : update_inertia;
  for (auto link = links_.rbegin(); link != links_.rend(); ++link)
    if (engine::SkeletonMembers::tree(skeleton_, (*link)->tree).mArticulatedInertia)
      update(**link, dt);
  for (std::size_t tree = 0; tree < skeleton_.getNumTrees(); ++tree)
    engine::SkeletonMembers::tree(skeleton_, tree).mArticulatedInertia = only_implicit;
}

/// The one with implicit damping and springs alone.
[[gnu::flatten]] void TreeDynamics::update_implicit_inertia(Link& link, double dt)
{
  Matrix6& implicit = *link.articulated_implicit;
  implicit = *link.inertia;
  for (const Link* child : link.children)
    add_child_inertia(*child, *child->articulated_implicit, true, implicit);
  if (link.kinematic)
    return;
  visit(link, [&](auto& joint) {
    using Space = SpaceOf<decltype(joint)>;
    const auto& J = jacobian(joint, link.constant);
    typename Space::Matrix projected = J.transpose() * implicit * J;
    add_implicit_terms(joint, dt, projected);
    joint.*Generic<Space>::inverse_inertia_implicit = inverse_inertia<Space>(projected);
  });
}

/// Without and with implicit damping and springs; what is the same is formed once.
[[gnu::flatten]] void TreeDynamics::update_inertia(Link& link, double dt)
{
  Matrix6& plain = *link.articulated;
  Matrix6& implicit = *link.articulated_implicit;
  link.implicit = false;
  plain = *link.inertia;
  for (const Link* child : link.children) {
    add_child_inertia(*child, *child->articulated, false, plain);
    link.implicit |= child->implicit;
  }
  implicit = link.implicit ? *link.inertia : plain;
  if (link.implicit)
    for (const Link* child : link.children)
      add_child_inertia(*child, *child->articulated_implicit, true, implicit);
  if (link.kinematic)
    return;
  visit(link, [&](auto& joint) {
    using Space = SpaceOf<decltype(joint)>;
    const auto& J = jacobian(joint, link.constant);
    typename Space::Matrix projected = J.transpose() * plain * J;
    joint.*Generic<Space>::inverse_inertia = inverse_inertia<Space>(projected);
    if (link.implicit)
      projected = J.transpose() * implicit * J;
    link.implicit |= add_implicit_terms(joint, dt, projected);
    joint.*Generic<Space>::inverse_inertia_implicit
        = link.implicit ? inverse_inertia<Space>(projected) : joint.*Generic<Space>::inverse_inertia;
  });
}

/// Adds what a body sees of its child's articulated inertia through the child's joint.
[[gnu::flatten, gnu::noinline]] void TreeDynamics::add_child_inertia(const Link& child, const Matrix6& inertia, bool implicit, Matrix6& sum)
{
  const Eigen::Isometry3d& T = *child.transform;
  if (child.kinematic || child.kind == Kind::none) {
    add_inertia_to_parent(T, inertia, sum);
    return;
  }
  visit(child, [&](auto& joint) {
    using Space = SpaceOf<decltype(joint)>;
    const auto& inverse = joint.*(implicit ? Generic<Space>::inverse_inertia_implicit : Generic<Space>::inverse_inertia);
    const typename Space::JacobianMatrix IJ = inertia * jacobian(joint, child.constant);
    Matrix6 left = inertia;
    left.noalias() -= IJ * inverse * IJ.transpose();
    add_inertia_to_parent(T, left, sum);
  });
}

/// What acts on a body beside its joint to the parent, and of it what that joint feels.
[[gnu::flatten]] void TreeDynamics::update_bias_force(Link& link, const Eigen::Vector3d& gravity, double dt)
{
  BodyNode& body = *link.body;
  const Matrix6& I = *link.inertia;
  Vector6 weight;
  if (body.getGravityMode()) {
    Vector6 g = Vector6::Zero();
    g.tail<3>().noalias() = (link.frame->*FrameOf::transform).linear().transpose() * gravity;
    weight.noalias() = I * g;
  } else {
    weight.setZero();
  }
  const Vector6& V = link.frame->*FrameOf::velocity;
  Vector6& bias = *link.bias_force;
  bias = -spatial::minus_cross_force(V, I * V) - *link.external_force - weight;
  for (const Link* child : link.children)
    add_child_bias_force(*child, bias);
  if (link.kind == Kind::none)
    return;
  const Vector6 force = *link.articulated_implicit * *link.partial_acceleration + bias;
  visit(link, [&](auto& joint) { update_total_force(joint, link, force, dt); });
}

[[gnu::flatten]] void TreeDynamics::add_child_bias_force(const Link& child, Vector6& sum)
{
  const Vector6& force = *child.bias_force;
  const Matrix6& I = *child.articulated_implicit;
  const Vector6& partial = *child.partial_acceleration;
  const Eigen::Isometry3d& T = *child.transform;
  if (child.kind == Kind::none)
    sum += spatial::to_parent(T, force + I * partial);
  visit(child, [&](auto& joint) {
    using Space = SpaceOf<decltype(joint)>;
    const auto& J = jacobian(joint, child.constant);
    Vector6 a = partial;
    if (child.kinematic) {
      a += J * state(joint).mAccelerations;
    } else {
      const typename Space::JacobianMatrix JP = J * joint.*Generic<Space>::inverse_inertia_implicit;
      a += JP * joint.*Generic<Space>::total_force;
    }
    Vector6 beta = force;
    beta.noalias() += I * a;
    sum += spatial::to_parent(T, beta);
  });
}

/// The force along a joint's dofs; of a joint whose motion is prescribed the acceleration.
template <class Space>
void TreeDynamics::update_total_force(GenericJoint<Space>& joint, const Link& link, const Vector6& force, double dt)
{
  auto& s = state(joint);
  switch (actuator(joint)) {
  case Joint::FORCE:
    s.mForces = s.mCommands;
    break;
  case Joint::ACCELERATION:
    assign(s.mAccelerations, s.mCommands);
    return;
  case Joint::VELOCITY:
    assign<typename Space::Vector>(s.mAccelerations, (s.mCommands - s.mVelocities) / dt);
    return;
  case Joint::LOCKED: // at rest (is_for_engine)
    assign<typename Space::Vector>(s.mAccelerations, Space::Vector::Zero());
    return;
  default: // passive; servo and mimic joints are driven by constraints
    s.mForces.setZero();
  }
  const auto& p = properties(joint);
  const typename Space::Vector spring
      = -p.mSpringStiffnesses.cwiseProduct(s.mPositions - p.mRestPositions + s.mVelocities * dt);
  const typename Space::Vector damping = -p.mDampingCoefficients.cwiseProduct(s.mVelocities);
  joint.*Generic<Space>::total_force
      = s.mForces + spring + damping - jacobian(joint, link.constant).transpose() * force;
}

[[gnu::flatten]] void TreeDynamics::update_acceleration(Link& link, double dt)
{
  BodyNode& body = *link.body;
  Joint& joint = *link.joint;
  const Matrix6& I = *link.articulated_implicit;
  const Vector6 from_parent = spatial::to_child(*link.transform, link.parent_frame->*FrameOf::acceleration);
  Vector6 primary = joint.*JointOf::primary_acceleration;
  visit(link, [&](auto& typed) {
    using Space = SpaceOf<decltype(typed)>;
    const auto& J = jacobian(typed, link.constant);
    if (!link.kinematic) {
      const Eigen::Matrix<double, Space::NumDofs, 6> JI = J.transpose() * I;
      const typename Space::Vector taken = JI * from_parent, left = typed.*Generic<Space>::total_force - taken;
      assign<typename Space::Vector>(state(typed).mAccelerations, typed.*Generic<Space>::inverse_inertia_implicit * left);
    }
    primary = J * state(typed).mAccelerations;
    if (shared_ == nullptr) {
      joint.*JointOf::primary_acceleration = primary;
      joint.*JointOf::primary_acceleration_dirty = false;
    }
  });
  Vector6& a = link.frame->*FrameOf::acceleration;
  a = from_parent + primary + *link.partial_acceleration;
  link.entity->*EntityOf::acceleration_dirty = false;
  Vector6& F = body.*Body::force;
  F = *link.bias_force;
  F.noalias() += I * a;
  if (link.kinematic)
    visit(link, [&](auto& typed) { update_driving_force(typed, link, dt); });
}

/// What it takes to prescribe a joint's motion.
template <class Space>
void TreeDynamics::update_driving_force(GenericJoint<Space>& joint, const Link& link, double dt)
{
  auto& s = state(joint);
  const auto& p = properties(joint);
  s.mForces = jacobian(joint, link.constant).transpose() * (link.body->*Body::force);
  const typename Space::Vector damping = -p.mDampingCoefficients.cwiseProduct(s.mVelocities + s.mAccelerations * dt);
  s.mForces -= damping;
  const typename Space::Vector spring = -p.mSpringStiffnesses.cwiseProduct(
      s.mPositions - p.mRestPositions + s.mVelocities * dt + s.mAccelerations * dt * dt);
  s.mForces -= spring;
}

} // namespace pydart2
