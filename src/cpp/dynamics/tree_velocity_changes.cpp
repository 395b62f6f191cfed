#include "dynamics/spatial_inline.hpp"
#include "dynamics/tree_joints.hpp"

// What the impulses of contacts and constraints change.

namespace pydart2 {

using namespace tree;

void TreeDynamics::apply_impulses()
{
  if (skeleton_.getNumDofs() == 0)
    return;
  const double dt = skeleton_.getTimeStep();
  pushed_off_ = true;
  put_numbers(nullptr);
  for (auto& link : links_)
    link->joint->getRelativeTransform();
  update_inertias();
  for (auto link = links_.rbegin(); link != links_.rend(); ++link)
    update_bias_impulse(**link);
  mark_velocities();
  for (auto& link : links_)
    update_velocity_change(*link, dt);
}

void TreeDynamics::clear_impulses()
{
  for (auto& link : links_) {
    BodyNode& body = *link->body;
    for (auto* impulse : {&(body.*Body::velocity_change), &(body.*Body::bias_impulse), &(body.*Body::constraint_impulse),
                          &(body.*Body::impulse)})
      impulse->setZero();
    visit(*link, [](auto& joint) {
      using Space = SpaceOf<decltype(joint)>;
      (joint.*Generic<Space>::constraint_impulses).setZero();
      (joint.*Generic<Space>::total_impulse).setZero();
      (joint.*Generic<Space>::velocity_change).setZero();
    });
  }
}

[[gnu::flatten]] void TreeDynamics::update_bias_impulse(Link& link)
{
  BodyNode& body = *link.body;
  Vector6& bias = body.*Body::bias_impulse;
  bias = -(body.*Body::constraint_impulse);
  for (const Link* child : link.children) {
    const Eigen::Isometry3d& T = *child->transform;
    const Vector6& impulse = child->body->*Body::bias_impulse;
    if (child->kinematic || child->kind == Kind::none) {
      bias += spatial::to_parent(T, impulse);
      continue;
    }
    visit(*child, [&](auto& joint) {
      using Space = SpaceOf<decltype(joint)>;
      const typename Space::JacobianMatrix IJ = *child->articulated * jacobian(joint, child->constant);
      const typename Space::JacobianMatrix IJP = IJ * joint.*Generic<Space>::inverse_inertia;
      Vector6 beta = impulse;
      beta.noalias() += IJP * joint.*Generic<Space>::total_impulse;
      bias += spatial::to_parent(T, beta);
    });
  }
  if (!link.kinematic)
    visit(link, [&](auto& joint) {
      using Space = SpaceOf<decltype(joint)>;
      joint.*Generic<Space>::total_impulse
          = joint.*Generic<Space>::constraint_impulses - jacobian(joint, link.constant).transpose() * bias;
    });
}

[[gnu::flatten]] void TreeDynamics::update_velocity_change(Link& link, double dt)
{
  BodyNode& body = *link.body;
  const Matrix6& I = *link.articulated;
  Vector6& change = body.*Body::velocity_change;
  const Vector6 from_parent = link.parent == nullptr
                                  ? Vector6(Vector6::Zero())
                                  : spatial::to_child(*link.transform, link.parent->body->*Body::velocity_change);
  change = from_parent;
  visit(link, [&](auto& joint) {
    using Space = SpaceOf<decltype(joint)>;
    const auto& J = jacobian(joint, link.constant);
    auto& joint_change = joint.*Generic<Space>::velocity_change;
    if (!link.kinematic) {
      const Eigen::Matrix<double, Space::NumDofs, 6> JI = J.transpose() * I;
      const typename Space::Vector taken = JI * from_parent, left = joint.*Generic<Space>::total_impulse - taken;
      joint_change = joint.*Generic<Space>::inverse_inertia * left;
    }
    change.noalias() += J * joint_change;
  });
  Vector6& impulse = body.*Body::impulse;
  impulse = body.*Body::bias_impulse;
  impulse.noalias() += I * change;
  visit(link, [&](auto& joint) {
    using Space = SpaceOf<decltype(joint)>;
    auto& s = state(joint);
    auto& impulses = joint.*Generic<Space>::impulses;
    if (link.kinematic)
      impulses = jacobian(joint, link.constant).transpose() * (body.*Body::force); // the engine's rule
    if (link.kind == Kind::se3) { // which has one of its own in Debian's engine
      (link.joint->*JointOf::add_impulse_terms)(dt);
      return;
    }
    if (link.kinematic) {
      s.mForces.noalias() += impulses / dt;
      return;
    }
    const double rate = 1.0 / dt;
    const auto& joint_change = joint.*Generic<Space>::velocity_change;
    assign<typename Space::Vector>(s.mVelocities, s.mVelocities + joint_change);
    assign<typename Space::Vector>(s.mAccelerations, s.mAccelerations + joint_change * rate);
    s.mForces.noalias() += impulses * rate;
  });
  body.*Body::force += impulse / dt;
}

} // namespace pydart2
