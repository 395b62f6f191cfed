#pragma once

#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>

namespace pydart2 {

/// A ball joint between two bodies, with the skeletons that it needs alive and what it takes to make it again.
struct ConstraintRecord
{
  dart::constraint::ConstraintBasePtr constraint;
  dart::dynamics::SkeletonPtr skeleton1, skeleton2;
  dart::dynamics::BodyNode *body1, *body2;
  Eigen::Vector3d point;                  ///< World frame, when it was made.
  Eigen::VectorXd positions1, positions2; ///< Positions of the skeletons when it was made.
};

/// Makes a ball joint at a point of the world, as the bodies stand now, and adds it.
ConstraintRecord add_ball_joint(
    dart::constraint::ConstraintSolver& solver,
    dart::dynamics::BodyNode& body1,
    dart::dynamics::BodyNode& body2,
    const Eigen::Vector3d& point);

/// Makes it again from its record; the engine's keeps the multipliers of the last step.
void renew(ConstraintRecord& record, dart::constraint::ConstraintSolver& solver);

} // namespace pydart2
