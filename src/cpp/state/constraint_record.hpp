#pragma once

#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <optional>
#include <vector>

#include "dynamics/held_motion.hpp"

namespace pydart2 {

/// A joint that a user added between two bodies, or between one and the world (body2 is null), with the skeletons that it
/// needs alive and what it takes to make it again.
struct ConstraintRecord
{
  enum class Kind { ball, weld, revolute, distance };
  static constexpr int num_kinds = 4;

  Kind kind = Kind::ball;
  int id = 0; ///< Of its own in the world.
  dart::dynamics::BodyNode *body1 = nullptr, *body2 = nullptr;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< Of all but welds, world frame, when it was made.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< Of a revolute joint, of length 1, world frame, when it was made.
  Eigen::Vector3d point2 = Eigen::Vector3d::Zero(); ///< The other end of a distance, world frame, when it was made.
  double length = 0.0;                             ///< Of a distance.
  bool rope = false;                               ///< A distance that may be shorter.
  std::optional<Eigen::Isometry3d> target;         ///< Of one in the world, if it was moved.
  bool enabled = true;
  Eigen::VectorXd positions1, positions2; ///< Positions of the skeletons when it was made.
  dart::dynamics::SkeletonPtr skeleton1, skeleton2;
  std::vector<dart::constraint::ConstraintBasePtr> parts; ///< A revolute joint is two ball joints on its axis.
  std::vector<Tie> ties;                                  ///< The same as points that coincide; a rope has none.
};

/// Makes the joint of a record that has its kind, bodies and point, as the bodies stand now, and adds it.
void add(ConstraintRecord& record, dart::constraint::ConstraintSolver& solver);

/// Takes it out of the solver.
void remove(const ConstraintRecord& record, dart::constraint::ConstraintSolver& solver);

/// Lets it act, or not.
void enable(ConstraintRecord& record, dart::constraint::ConstraintSolver& solver, bool on);

/// Moves where one in the world holds its body; a ball joint takes the translation.
void set_target(ConstraintRecord& record, const Eigen::Isometry3d& target);

/// Makes it again from its record; the engine's keeps the multipliers of the last step.
void renew(ConstraintRecord& record, dart::constraint::ConstraintSolver& solver);

} // namespace pydart2
