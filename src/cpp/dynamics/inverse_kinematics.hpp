#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <optional>
#include <random>
#include <vector>

namespace pydart2 {

/// Where a point of a body, or its axes, should be in the world; without a body, the centre of mass.
struct IkTarget
{
  const dart::dynamics::BodyNode* body = nullptr;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> position;
  std::optional<Eigen::Matrix3d> rotation;
  double weight = 1;
};

struct IkOptions
{
  double tolerance; ///< Of each target's distance and angle, m and rad.
  int iterations;   ///< At most this many from one start.
  int restarts;
  unsigned seed;
};

struct IkResult
{
  Eigen::VectorXd q;
  double residual; ///< The largest distance or angle that is left, m or rad.
  bool converged;
  int restarts, iterations;
};

/// Inverse kinematics by damped least squares within the limits of the joints: steps of
///
///   (J^T W J + lambda E I) dq = J^T W e,   E = e^T W e / 2,
///
/// with the damping by the error that is left of Chan & Lawrence, "General inverse kinematics with the error damped
/// pseudoinverse", ICRA 1988: short steps far from the target, Newton's near it. lambda grows when a step does not help.
/// A dof at a limit that the step would push further is held for that step. Where no step helps any more, the search
/// starts again from random positions within the limits.
///
/// With a posture, the dofs that the targets leave free then go towards it, by its projection on the null space of J.
class InverseKinematics
{
public:
  InverseKinematics(dart::dynamics::Skeleton& skeleton, std::vector<IkTarget> targets, const std::vector<bool>& moves);

  IkResult solve(const Eigen::VectorXd& start, const Eigen::VectorXd* posture, const IkOptions& options);

private:
  struct Group ///< A joint with dofs that move.
  {
    dart::dynamics::Joint* joint;
    long first, size;
    bool ball; ///< First three dofs are a rotation vector, whose rates are angular velocities.
  };

  void put(const Eigen::VectorXd& q);
  void measure();
  void linearise();
  double cost() const { return 0.5 * error_.squaredNorm(); }
  bool descend(const IkOptions& options, int& iterations);
  bool step(double damping, Eigen::VectorXd& moved);
  void hold_dofs_at_limits(const Eigen::VectorXd& direction);
  void approach(const Eigen::VectorXd& posture, const IkOptions& options, int& iterations);
  Eigen::VectorXd towards(const Eigen::VectorXd& posture);
  void moved_by(const Eigen::VectorXd& dq, Eigen::VectorXd& q) const;
  Eigen::VectorXd random_start(const Eigen::VectorXd& start, int attempt, std::mt19937& random) const;

  dart::dynamics::Skeleton& skeleton_;
  std::vector<IkTarget> targets_;
  std::vector<Group> groups_;
  Eigen::VectorXd moves_;               ///< 1 for each dof that may move, 0 for the others.
  Eigen::VectorXd lower_, upper_;
  Eigen::VectorXd q_, free_;            ///< free_: moves_ without the dofs that are held.
  Eigen::VectorXd error_;               ///< Weighted.
  Eigen::MatrixXd J_;                   ///< Weighted, of the error's decrease.
  double residual_ = 0;
};

} // namespace pydart2
