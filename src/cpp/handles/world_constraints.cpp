// The constraints between bodies that a user adds to a world.

#include <algorithm>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "engine/engine_access.hpp"
#include "handles/world.hpp"
#include "state/sleeping.hpp"

namespace pydart2 {

void WorldHandle::add_ball_joint_constraint(
    const BodyNodeHandle& body1, const BodyNodeHandle& body2, const Eigen::Vector3d& point)
{
  check::finite(point, "joint position");
  Eigen::Matrix<double, 11, 1> numbers = Eigen::Matrix<double, 11, 1>::Zero();
  numbers.head<3>() = point;
  add_constraint(static_cast<int>(ConstraintRecord::Kind::ball), body1.body(), &body2.body(), {numbers.data(), 11});
}

int WorldHandle::add_constraint_to_world(long kind, const BodyNodeHandle& body, const VectorIn& numbers)
{
  return add_constraint(kind, body.body(), nullptr, numbers);
}

int WorldHandle::add_constraint_between(
    long kind, const BodyNodeHandle& body1, const BodyNodeHandle& body2, const VectorIn& numbers)
{
  return add_constraint(kind, body1.body(), &body2.body(), numbers);
}

int WorldHandle::add_constraint(
    long kind, dart::dynamics::BodyNode& a, dart::dynamics::BodyNode* b, const VectorIn& numbers)
{
  auto& record = world();
  check::size(numbers.size, 11, "numbers of a constraint");
  check::finite(numbers, "the places and lengths of a constraint");
  if (record.index_of(a.getSkeleton()) < 0 || (b && record.index_of(b->getSkeleton()) < 0))
    throw Error(Kind::value, "both bodies of a constraint must be in the world that it is added to");
  if (&a == b)
    throw Error(Kind::value, "a constraint needs two different bodies, got '" + a.getName() + "' twice");
  const Eigen::Map<const Eigen::VectorXd> values(numbers.data, 11);
  ConstraintRecord added;
  added.kind = static_cast<ConstraintRecord::Kind>(check::index(kind, ConstraintRecord::num_kinds, "kind of constraint"));
  if (added.kind == ConstraintRecord::Kind::revolute) {
    check::direction(values.segment<3>(3), "the axis of a constraint");
    added.axis = values.segment<3>(3).stableNormalized();
  }
  check::not_negative(values[9], "the length of a constraint");
  added.id = ++record.last_constraint;
  added.body1 = &a;
  added.body2 = b;
  added.point = values.head<3>();
  added.point2 = values.segment<3>(6);
  added.length = values[9];
  added.rope = values[10] != 0.0;
  wake_held(record, added);
  pydart2::add(added, *record.world->getConstraintSolver());
  record.constraints.push_back(added);
  return added.id;
}

void WorldHandle::constraint(long index, Output& out) const
{
  const auto& record = world();
  const auto& one = record.constraints[check::index(index, record.constraints.size(), "constraint")];
  const auto body = [](const dart::dynamics::BodyNode* b) { return b ? double(b->getIndexInSkeleton()) : -1.0; };
  vector(out, 17) << double(one.id), double(one.kind), double(record.index_of(one.skeleton1)), body(one.body1),
      one.skeleton2 ? double(record.index_of(one.skeleton2)) : -1.0, body(one.body2), one.point, one.axis,
      one.point2, one.length, double(one.rope);
}

ConstraintRecord& WorldHandle::constraint_of(long id) const
{
  for (auto& one : world().constraints)
    if (one.id == id)
      return one;
  throw Error(Kind::destroyed, "this constraint was removed from its world, or a body that it held was");
}

bool WorldHandle::constraint_is_enabled(long id) const
{
  return constraint_of(id).enabled;
}

void WorldHandle::set_constraint_enabled(long id, bool on)
{
  auto& one = constraint_of(id);
  wake_held(world(), one);
  enable(one, *world().world->getConstraintSolver(), on);
}

void WorldHandle::set_constraint_target(long id, const Eigen::Matrix4d& target)
{
  auto& one = constraint_of(id);
  if (one.body2 != nullptr || one.kind == ConstraintRecord::Kind::revolute)
    throw Error(Kind::value, "only a ball joint or a weld between a body and the world has a target that can be moved");
  check::rigid(target, "the target of a constraint");
  wake_held(world(), one);
  set_target(one, Eigen::Isometry3d(target));
}

Vector6d WorldHandle::constraint_wrench(long id) const
{
  const auto& one = constraint_of(id);
  Vector6d wrench = Vector6d::Zero();
  if (one.enabled)
    for (const auto& part : one.parts)
      wrench += engine::impulse_on_first(*part) / world().world->getTimeStep();
  const Eigen::Matrix3d R = one.body1->getWorldTransform().linear();
  wrench << R * wrench.head<3>().eval(), R * wrench.tail<3>().eval();
  return wrench;
}

bool WorldHandle::remove_constraint(long id)
{
  auto& record = world();
  auto& all = record.constraints;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.id == id; });
  if (found == all.end())
    return false;
  wake_held(record, *found);
  remove(*found, *record.world->getConstraintSolver());
  all.erase(found);
  return true;
}

int WorldHandle::num_constraints() const
{
  return static_cast<int>(world().constraints.size());
}

void WorldHandle::remove_all_constraints()
{
  auto& record = to_change();
  record.world->getConstraintSolver()->removeAllConstraints();
  record.constraints.clear();
}

} // namespace pydart2
