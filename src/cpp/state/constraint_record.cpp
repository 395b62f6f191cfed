#include "state/constraint_record.hpp"

#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/WeldJointConstraint.hpp>
#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

using dart::constraint::BallJointConstraint;
using dart::constraint::ConstraintBasePtr;
using dart::constraint::ConstraintSolver;
using dart::constraint::WeldJointConstraint;

namespace {

ConstraintBasePtr make(const ConstraintRecord& record)
{
  const bool ball = record.kind == ConstraintRecord::Kind::ball;
  if (record.body2 == nullptr) {
    if (ball)
      return std::make_shared<BallJointConstraint>(record.body1, record.point);
    return std::make_shared<WeldJointConstraint>(record.body1);
  }
  if (ball)
    return std::make_shared<BallJointConstraint>(record.body1, record.body2, record.point);
  return std::make_shared<WeldJointConstraint>(record.body1, record.body2);
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
  record.constraint = make(record);
  solver.addConstraint(record.constraint);
}

void renew(ConstraintRecord& record, ConstraintSolver& solver)
{
  const Eigen::VectorXd positions1 = positions(record.skeleton1), positions2 = positions(record.skeleton2);
  set_positions(record, record.positions1, record.positions2);
  if (record.constraint)
    solver.removeConstraint(record.constraint);
  add(record, solver);
  set_positions(record, positions1, positions2);
}

} // namespace pydart2
