#include "dynamics/tree_impulses.hpp"

#include <algorithm>
#include <dart/dynamics/Joint.hpp>

#include "dynamics/spatial_inline.hpp"
#include "engine/engine_access.hpp"
#include "engine/tree_members.hpp"

namespace pydart2 {

namespace {

using Vector6 = TreeImpulses::Vector6;
using dart::dynamics::BodyNode;
using dart::dynamics::GenericJoint;
using spatial::to_child;
using spatial::to_parent;

} // namespace

void TreeImpulses::clear()
{
  bodies_.clear();
  trees_.clear();
  numbers_.clear();
}

int TreeImpulses::add(BodyNode& node)
{
  if (const int known = find(&node); known != none)
    return known;
  auto* above = node.getParentBodyNode();
  const int parent = above == nullptr ? none : add(*above);
  const int number = size();
  if (parent == none) {
    trees_.push_back({number, number, node.getSkeleton().get()});
  } else {
    auto& last = trees_[bodies_[parent].tree].last;
    bodies_[last].next = number;
    last = number;
  }
  const int tree = parent == none ? static_cast<int>(trees_.size()) - 1 : bodies_[parent].tree;
  auto& body = bodies_.emplace_back();
  body.node = &node;
  body.parent = parent;
  body.tree = tree;
  numbers_.try_emplace(&node, number);
  return number;
}

void TreeImpulses::prepare()
{
  for (auto& body : bodies_) {
    if (body.parent == none)
      body.node->getArticulatedInertia(); // brings those of the whole tree up to date
    body.T = body.node->getParentJoint()->getRelativeTransform();
    read_joint(body);
  }
  for (auto body = bodies_.rbegin(); body != bodies_.rend(); ++body)
    if (body->parent != none)
      bodies_[body->parent].last_row = std::max(bodies_[body->parent].last_row, body->last_row);
}

void TreeImpulses::read_joint(Body& body)
{
  const auto& joint = *body.node->getParentJoint();
  const auto dofs = joint.isKinematic() ? 0 : joint.getNumDofs();
  if (dofs == 0)
    body.joint = FixedJoint();
  else if (dofs == 1)
    read_moving_joint<dart::math::R1Space>(body);
  else if (dofs == 2)
    read_moving_joint<dart::math::R2Space>(body);
  else if (dofs == 6)
    read_moving_joint<dart::math::SE3Space>(body);
  else if (dynamic_cast<const GenericJoint<dart::math::SO3Space>*>(&joint) != nullptr)
    read_moving_joint<dart::math::SO3Space>(body);
  else
    read_moving_joint<dart::math::R3Space>(body);
}

template <class Space>
void TreeImpulses::read_moving_joint(Body& body)
{
  auto& joint = static_cast<GenericJoint<Space>&>(*body.node->getParentJoint());
  const auto& I = body.node->*engine::BodyMembers::inertia;
  body.velocities = (joint.*engine::GenericJointMembers<Space>::state).mVelocities.data();
  auto& terms = body.joint.emplace<MovingJoint<static_cast<int>(Space::NumDofs)>>();
  terms.J = joint.getRelativeJacobianStatic();
  terms.P = engine::InverseProjectedInertia<Space>::of(joint);
  terms.K = I * terms.J * terms.P;
  terms.G = terms.J.transpose() * I;
}

void TreeImpulses::push_joint(int body, int dof)
{
  std::visit(
      [dof](auto& joint) {
        if constexpr (!std::is_same_v<decltype(joint), FixedJoint&>)
          joint.c[dof] = 1.0;
      },
      bodies_[body].joint);
}

double TreeImpulses::joint_velocity_change(int body, int dof) const
{
  return std::visit(
      [dof](const auto& joint) {
        if constexpr (std::is_same_v<decltype(joint), const FixedJoint&>)
          return 0.0;
        else
          return joint.change[dof];
      },
      bodies_[body].joint);
}

int TreeImpulses::dofs(int body) const
{
  return std::visit([](const auto& joint) { return std::decay_t<decltype(joint)>::dofs; }, bodies_[body].joint);
}

void TreeImpulses::solve(int body1, int body2, int row)
{
  // Bodies have higher numbers than their parents: the higher one of two paths' ends is never above the other.
  for (int a = body1, b = body2; a != none || b != none;) {
    const int number = std::max(a, b);
    auto& body = bodies_[number];
    send_up(body);
    if (a == number)
      a = body.parent;
    if (b == number)
      b = body.parent;
  }
  if (body1 != none)
    send_down(tree(body1), row);
  if (body2 != none && (body1 == none || tree(body1) != tree(body2)))
    send_down(tree(body2), row);
}

[[gnu::flatten]] void TreeImpulses::send_up(Body& body)
{
  std::visit(
      [&](auto& joint) {
        if constexpr (std::is_same_v<decltype(joint), FixedJoint&>) {
          if (body.parent != none)
            bodies_[body.parent].bias += to_parent(body.T, body.bias);
        } else {
          joint.tau = joint.c - joint.J.transpose() * body.bias;
          joint.c.setZero();
          if (body.parent != none)
            bodies_[body.parent].bias += to_parent(body.T, body.bias + joint.K * joint.tau);
        }
      },
      body.joint);
  body.bias.setZero();
}

[[gnu::flatten]] void TreeImpulses::send_down(int tree, int row)
{
  for (int number = first(tree); number != none; number = next(number)) {
    auto& body = bodies_[number];
    if (body.last_row < row)
      continue;
    if (body.parent == none)
      body.change.setZero();
    else
      body.change = to_child(body.T, bodies_[body.parent].change);
    std::visit(
        [&](auto& joint) {
          if constexpr (!std::is_same_v<decltype(joint), FixedJoint&>) {
            joint.change = joint.P * (joint.tau - joint.G * body.change);
            joint.tau.setZero();
            body.change.noalias() += joint.J * joint.change;
          }
        },
        body.joint);
  }
}

} // namespace pydart2
