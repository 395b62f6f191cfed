#include <algorithm>
#include <cstring>
#include <utility>

#include "dynamics/spatial_inline.hpp"
#include "dynamics/tree_joints.hpp"

// How velocities and positions go on, and what is out of date then.

namespace pydart2 {

using namespace tree;

namespace {

/// How a ball joint goes on.
[[gnu::flatten]] Eigen::Vector3d turned(const Eigen::Vector3d& q, const Eigen::Vector3d& dq, double dt)
{
  if ((q.array() == 0.0).all() && (dq.array() == 0.0).all())
    return q;
  return spatial::rotation_vector(spatial::rotation(q) * spatial::rotation(dq * dt));
}

/// A free joint's acceleration is spatial, and its linear velocity is to be that of the moved point: as
/// FreeJoint::integrateVelocities() of Debian's engine. Whether anything has changed.
[[gnu::flatten]] bool accelerate_free(GenericJoint<dart::math::SE3Space>& joint, double dt)
{
  auto& s = state(joint);
  Vector6 acceleration = s.mAccelerations;
  acceleration.tail<3>() += s.mVelocities.head<3>().cross(s.mVelocities.tail<3>());
  const bool faster = assign<Vector6>(s.mVelocities, s.mVelocities + acceleration * dt);
  acceleration.tail<3>() -= s.mVelocities.head<3>().cross(s.mVelocities.tail<3>());
  return assign(s.mAccelerations, acceleration) || faster;
}

/// Velocity and acceleration turn into the axes of the moved body: as FreeJoint::integratePositions() of Debian's engine.
/// Whether anything has changed.
[[gnu::flatten]] bool move_free(GenericJoint<dart::math::SE3Space>& joint, double dt)
{
  auto& s = state(joint);
  const Eigen::Isometry3d now = joint.*JointOf::transform_dirty
                                    ? spatial::placement(s.mPositions)
                                    : static_cast<FreeJoint&>(joint).*engine::FreeJointMembers::moved;
  const Eigen::Isometry3d step = spatial::placement(s.mVelocities * dt), next = now * step;
  const Eigen::Isometry3d back = step.inverse();
  const auto turned_back = [&back](const Vector6& twist) {
    Vector6 result;
    result.head<3>().noalias() = back.linear() * twist.head<3>();
    result.tail<3>().noalias() = back.linear() * twist.tail<3>();
    return result;
  };
  Vector6 positions;
  positions << spatial::rotation_vector(next.linear()), next.translation();
  bool changed = assign(s.mVelocities, turned_back(s.mVelocities));
  changed |= assign(s.mAccelerations, turned_back(s.mAccelerations));
  return assign(s.mPositions, positions) || changed;
}

} // namespace

void TreeDynamics::integrate_velocities(double dt, bool asked_for)
{
  bool changed = false;
  for (auto& link : links_)
    visit(*link, [&](auto& joint) {
      using Space = SpaceOf<decltype(joint)>;
      auto& s = state(joint);
      if constexpr (std::is_same_v<Space, dart::math::SE3Space>)
        changed |= accelerate_free(joint, dt);
      else
        changed |= assign<typename Space::Vector>(s.mVelocities, s.mVelocities + s.mAccelerations * dt);
    });
  if (changed)
    mark_predicted_velocities();
  if (asked_for)
    for (auto& link : links_)
      update_velocity(*link);
}

void TreeDynamics::integrate_positions(double dt)
{
  for (std::size_t i = 0; i < links_.size() && fetch_ahead_; ++i) {
    fetch_flags(i);
    for (const Entity* other : links_[i]->others)
      fetch(other->*EntityOf::transform_dirty);
  }
  bool changed = false;
  for (auto& link : links_)
    visit(*link, [&](auto& joint) {
      using Space = SpaceOf<decltype(joint)>;
      using Vector = typename Space::Vector;
      auto& s = state(joint);
      if constexpr (std::is_same_v<Space, dart::math::SE3Space>)
        changed |= move_free(joint, dt);
      else if constexpr (std::is_same_v<Space, dart::math::SO3Space>)
        changed |= assign<Vector>(s.mPositions, turned(s.mPositions, s.mVelocities, dt));
      else
        changed |= assign<Vector>(s.mPositions, s.mPositions + dt * s.mVelocities);
    });
  moved_ = changed;
  if (changed)
    mark_positions();
}

void TreeDynamics::look_at_forces(bool commands_at_rest)
{
  static const Vector6 none = Vector6::Zero();
  forces_at_rest_ = commands_at_rest && std::all_of(links_.begin(), links_.end(), [](const auto& link) {
    return std::memcmp(link->external_force->data(), none.data(), sizeof none) == 0;
  });
}

void TreeDynamics::clear_internal_forces()
{
  for (auto& link : links_)
    visit(*link, [](auto& joint) { state(joint).mForces.setZero(); });
}

void TreeDynamics::keep_up(long changes)
{
  if (std::exchange(changes_, changes) != changes)
    look();
}

void TreeDynamics::look()
{
  for (auto& link : links_) {
    const auto& others = link->body->*Body::others;
    link->others.assign(others.begin(), others.end());
    link->heard = !std::all_of(others.begin(), others.end(), [](const Entity* other) { return is_unheard(*other); });
  }
}

void TreeDynamics::mark_positions()
{
  for (auto& link : links_) {
    mark_velocity(*link);
    mark_acceleration(*link);
    mark_position(*link);
  }
  const auto mark = [](auto& dirty) {
    dirty.mArticulatedInertia = dirty.mMassMatrix = dirty.mAugMassMatrix = dirty.mInvMassMatrix = dirty.mInvAugMassMatrix
        = dirty.mGravityForces = dirty.mExternalForces = dirty.mCoriolisForces = dirty.mCoriolisAndGravityForces = true;
  };
  each_cache(mark);
}

void TreeDynamics::mark_velocities()
{
  for (auto& link : links_) {
    mark_velocity(*link);
    mark_acceleration(*link);
  }
  each_cache([](auto& dirty) { dirty.mCoriolisForces = dirty.mCoriolisAndGravityForces = true; });
}

void TreeDynamics::mark_predicted_velocities()
{
  for (auto& link : links_)
    mark_predicted_velocity(*link);
  each_cache([](auto& dirty) { dirty.mCoriolisForces = dirty.mCoriolisAndGravityForces = true; });
}

void TreeDynamics::mark_accelerations()
{
  for (auto& link : links_)
    mark_acceleration(*link);
}

/// Of the skeleton and of each of its trees.
template <class Mark>
void TreeDynamics::each_cache(const Mark& mark)
{
  mark(engine::SkeletonMembers::all(skeleton_));
  for (std::size_t tree = 0; tree < skeleton_.getNumTrees(); ++tree)
    mark(engine::SkeletonMembers::tree(skeleton_, tree));
}

void TreeDynamics::fetch_flags(std::size_t i) const
{
  if (!fetch_ahead_ || i >= links_.size())
    return;
  const Link& link = *links_[i];
  visit(link, [](auto& joint) { fetch(state(joint)); });
  fetch(link.joint->*JointOf::transform_dirty);
  fetch(link.body->*Body::jacobian_dirty);
  fetch(link.entity->*EntityOf::transform_dirty);
}

void TreeDynamics::mark_position(Link& link)
{
  Joint& joint = *link.joint;
  BodyNode& body = *link.body;
  joint.*JointOf::transform_dirty = joint.*JointOf::jacobian_dirty = true;
  if (!(body.*Body::jacobian_dirty))
    (body.*Body::mark_jacobian)();
  if (link.entity->*EntityOf::transform_dirty)
    return;
  link.entity->*EntityOf::transform_dirty = true;
  for (Entity* other : link.others)
    if (link.heard
        || !(other->*EntityOf::transform_dirty && other->*EntityOf::velocity_dirty && other->*EntityOf::acceleration_dirty))
      other->dirtyTransform();
}

void TreeDynamics::mark_velocity(Link& link)
{
  mark_rates(link);
  // Who asks for the partial acceleration asks for the velocity, too.
  if (link.entity->*EntityOf::velocity_dirty)
    return;
  link.body->*Body::partial_acceleration_dirty = true;
  link.entity->*EntityOf::velocity_dirty = true;
  for (Entity* other : link.others)
    if (link.heard || !(other->*EntityOf::velocity_dirty && other->*EntityOf::acceleration_dirty))
      other->dirtyVelocity();
}

/// What changes with the velocities but for body and shapes.
void TreeDynamics::mark_rates(Link& link)
{
  Joint& joint = *link.joint;
  BodyNode& body = *link.body;
  joint.*JointOf::velocity_dirty = joint.*JointOf::jacobian_rate_dirty = true;
  if (!(body.*Body::jacobian_rate_dirty && body.*Body::world_jacobian_rate_dirty))
    (body.*Body::mark_jacobian_rate)();
}

void TreeDynamics::mark_acceleration(Link& link)
{
  Joint& joint = *link.joint;
  joint.*JointOf::acceleration_dirty = joint.*JointOf::primary_acceleration_dirty = true;
  if (link.entity->*EntityOf::acceleration_dirty)
    return;
  link.entity->*EntityOf::acceleration_dirty = true;
  for (Entity* other : link.others)
    if (link.heard || !(other->*EntityOf::acceleration_dirty))
      other->dirtyAcceleration();
}

/// After accelerate(), by which nobody has asked for anything of the others that is out of date now.
void TreeDynamics::mark_predicted_velocity(Link& link)
{
  if (link.heard || !link.unread) {
    mark_velocity(link);
    return mark_acceleration(link);
  }
  mark_rates(link);
  Joint& joint = *link.joint;
  joint.*JointOf::acceleration_dirty = joint.*JointOf::primary_acceleration_dirty = true;
  link.entity->*EntityOf::velocity_dirty = link.entity->*EntityOf::acceleration_dirty = true;
  if (shared_ == nullptr)
    link.body->*Body::partial_acceleration_dirty = true;
}

} // namespace pydart2
