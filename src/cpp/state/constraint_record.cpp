#include "state/constraint_record.hpp"

#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/WeldJointConstraint.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include "engine/distance_constraint.hpp"

namespace pydart2 {

using dart::constraint::BallJointConstraint;
using dart::constraint::ConstraintBasePtr;
using dart::constraint::ConstraintSolver;
using dart::constraint::WeldJointConstraint;

namespace {

ConstraintBasePtr ball(const ConstraintRecord& record, const Eigen::Vector3d& point)
{
  if (record.body2 == nullptr)
    return std::make_shared<BallJointConstraint>(record.body1, point);
  return std::make_shared<BallJointConstraint>(record.body1, record.body2, point);
}

ConstraintBasePtr weld(const ConstraintRecord& record)
{
  if (record.body2 == nullptr)
    return std::make_shared<WeldJointConstraint>(record.body1);
  return std::make_shared<WeldJointConstraint>(record.body1, record.body2);
}

constexpr double half_span = 0.1; ///< m, between the two balls of a revolute joint.

std::vector<ConstraintBasePtr> make(const ConstraintRecord& record)
{
  switch (record.kind) {
  case ConstraintRecord::Kind::ball:
    return {ball(record, record.point)};
  case ConstraintRecord::Kind::weld:
    return {weld(record)};
  case ConstraintRecord::Kind::revolute:
    return {ball(record, record.point - half_span * record.axis), ball(record, record.point + half_span * record.axis)};
  case ConstraintRecord::Kind::distance:
    return {std::make_shared<engine::DistanceConstraint>(
        record.body1, record.body2, record.point, record.point2, record.length, record.rope)};
  }
  return {};
}

/// Points of the first body, in the world, that a joint holds: the more, the fewer motions it leaves.
std::vector<Eigen::Vector3d> held_points(const ConstraintRecord& record)
{
  const Eigen::Isometry3d& body = record.body1->getWorldTransform();
  switch (record.kind) {
  case ConstraintRecord::Kind::weld:
    return {body.translation(), body * (half_span * Eigen::Vector3d::UnitX()), body * (half_span * Eigen::Vector3d::UnitY())};
  case ConstraintRecord::Kind::revolute:
    return {record.point - half_span * record.axis, record.point + half_span * record.axis};
  case ConstraintRecord::Kind::ball:
  case ConstraintRecord::Kind::distance:
    break;
  }
  return {record.point};
}

std::vector<Tie> ties_of(const ConstraintRecord& record)
{
  const auto in = [](const dart::dynamics::BodyNode* body, const Eigen::Vector3d& point) -> Eigen::Vector3d {
    return body == nullptr ? point : body->getWorldTransform().inverse() * point;
  };
  const bool distance = record.kind == ConstraintRecord::Kind::distance;
  std::vector<Tie> ties;
  if (record.rope)
    return ties;
  for (const auto& point : held_points(record))
    ties.push_back({record.body1, record.body2, in(record.body1, point), in(record.body2, distance ? record.point2 : point),
                    record.length});
  return ties;
}

Eigen::VectorXd positions(const dart::dynamics::SkeletonPtr& skeleton)
{
  return skeleton ? skeleton->getPositions() : Eigen::VectorXd();
}

void set_positions(const ConstraintRecord& record, const Eigen::VectorXd& positions1, const Eigen::VectorXd& positions2)
{
  record.skeleton1->setPositions(positions1);
  if (record.skeleton2)
    record.skeleton2->setPositions(positions2);
}

} // namespace

void add(ConstraintRecord& record, ConstraintSolver& solver)
{
  record.skeleton1 = record.body1->getSkeleton();
  record.skeleton2 = record.body2 ? record.body2->getSkeleton() : nullptr;
  record.positions1 = positions(record.skeleton1);
  record.positions2 = positions(record.skeleton2);
  record.parts = make(record);
  record.ties = ties_of(record);
  if (record.target)
    set_target(record, *record.target);
  if (record.enabled)
    for (const auto& part : record.parts)
      solver.addConstraint(part);
}

void remove(const ConstraintRecord& record, ConstraintSolver& solver)
{
  if (record.enabled)
    for (const auto& part : record.parts)
      solver.removeConstraint(part);
}

void enable(ConstraintRecord& record, ConstraintSolver& solver, bool on)
{
  if (on == record.enabled)
    return;
  remove(record, solver);
  record.enabled = on;
  if (on)
    for (const auto& part : record.parts)
      solver.addConstraint(part);
}

void set_target(ConstraintRecord& record, const Eigen::Isometry3d& target)
{
  record.target = target;
  const bool weld = record.kind == ConstraintRecord::Kind::weld;
  for (auto& tie : record.ties)
    tie.point2 = weld ? Eigen::Vector3d(target * tie.point1) : Eigen::Vector3d(target.translation());
  for (const auto& part : record.parts)
    engine::set_target(*part, target);
}

void renew(ConstraintRecord& record, ConstraintSolver& solver)
{
  const Eigen::VectorXd positions1 = positions(record.skeleton1), positions2 = positions(record.skeleton2);
  set_positions(record, record.positions1, record.positions2);
  remove(record, solver);
  add(record, solver);
  set_positions(record, positions1, positions2);
}

} // namespace pydart2
