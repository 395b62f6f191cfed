#include "state/constraint_record.hpp"

#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

using dart::constraint::BallJointConstraint;
using dart::constraint::ConstraintSolver;

ConstraintRecord add_ball_joint(
    ConstraintSolver& solver, dart::dynamics::BodyNode& body1, dart::dynamics::BodyNode& body2, const Eigen::Vector3d& point)
{
  const auto skeleton1 = body1.getSkeleton(), skeleton2 = body2.getSkeleton();
  const auto constraint = std::make_shared<BallJointConstraint>(&body1, &body2, point);
  solver.addConstraint(constraint);
  return {constraint, skeleton1, skeleton2, &body1, &body2, point, skeleton1->getPositions(), skeleton2->getPositions()};
}

void renew(ConstraintRecord& record, ConstraintSolver& solver)
{
  const Eigen::VectorXd positions1 = record.skeleton1->getPositions(), positions2 = record.skeleton2->getPositions();
  record.skeleton1->setPositions(record.positions1);
  record.skeleton2->setPositions(record.positions2);
  if (record.constraint)
    solver.removeConstraint(record.constraint);
  record = add_ball_joint(solver, *record.body1, *record.body2, record.point);
  record.skeleton1->setPositions(positions1);
  record.skeleton2->setPositions(positions2);
}

} // namespace pydart2
