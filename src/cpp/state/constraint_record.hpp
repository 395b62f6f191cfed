#pragma once

#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>

namespace pydart2 {

/// A joint that a user added between two bodies, or between one and the world (body2 is null), with the skeletons that it
/// needs alive and what it takes to make it again.
struct ConstraintRecord
{
  enum class Kind { ball, weld };

  Kind kind = Kind::ball;
  int id = 0; ///< Of its own in the world.
  dart::dynamics::BodyNode *body1 = nullptr, *body2 = nullptr;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< Of a ball joint, world frame, when it was made.
  Eigen::VectorXd positions1, positions2;          ///< Positions of the skeletons when it was made.
  dart::dynamics::SkeletonPtr skeleton1, skeleton2;
  dart::constraint::ConstraintBasePtr constraint;
};

/// Makes the joint of a record that has its kind, bodies and point, as the bodies stand now, and adds it.
void add(ConstraintRecord& record, dart::constraint::ConstraintSolver& solver);

/// Makes it again from its record; the engine's keeps the multipliers of the last step.
void renew(ConstraintRecord& record, dart::constraint::ConstraintSolver& solver);

} // namespace pydart2
