#pragma once

#include <vector>

#include "base/arrays.hpp"
#include "dynamics/inverse_kinematics.hpp"
#include "handles/part.hpp"

namespace pydart2 {

/// A question of inverse kinematics about a skeleton: targets, then solve().
class InverseKinematicsHandle
{
public:
  InverseKinematicsHandle(WorldRef world, SkeletonRef skeleton);

  /// A position, a rotation or both, world frame; body -1 is the centre of mass. The offset is in the body frame.
  void add_target(
      long body,
      const Eigen::Vector3d& offset,
      const Eigen::Vector3d* position,
      const Eigen::Matrix3d* rotation,
      double weight);

  /// Which dofs move, by index; at first all do.
  void set_dofs(const VectorIn& indices);
  void set_posture(const VectorIn& posture);

  /// Its world, for solve(), whose caller holds the claim.
  Busy claim() const;

  /// Writes one row, [q, residual, converged, restarts, iterations]. The skeleton stays as it is.
  void solve(
      const VectorIn& start, double tolerance, long iterations, long restarts, long seed, const MatrixOut& found) const;

private:
  Part<dart::dynamics::Skeleton, dart::dynamics::Skeleton*> skeleton_; // SkeletonRecord owns it
  std::vector<IkTarget> targets_;
  std::vector<bool> moves_;
  Eigen::VectorXd posture_; ///< Empty for none.
};

} // namespace pydart2
