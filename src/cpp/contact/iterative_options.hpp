#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace pydart2 {

/// Settings of the iterative solver.
struct IterativeOptions
{
  enum class Friction {
    pyramid, ///< Each tangent within mu times the normal impulse.
    cone,    ///< Both together.
    engine   ///< Each tangent within mu times what the normal impulse is without friction.
  };

  int iterations = 28;         ///< Sweeps over all rows, at most.
  double tolerance = 3e-6;     ///< m/s, rad/s: the residual at which the sweeps end.
  Friction friction = Friction::pyramid;
  bool split = true;           ///< Depth is taken away by moving bodies, not by velocities (else as the engine does).
  double error_reduction = 0.2; ///< The part of the depth that goes in a step.
  double allowance = 1e-6;      ///< m: the depth that stays.
  double correction_speed = 1.0; ///< m/s: at most this fast.
  int threads = 1;               ///< That solve the groups; results do not depend on it.

  /// m/s, rad/s: what the sweeps leave at best, and is taken for rest.
  double noise() const { return std::min(tolerance, 3e-6); }
};

/// Iterations, tolerance, friction, split, error reduction, allowance, correction speed; all but the threads.
Eigen::VectorXd numbers_of(const IterativeOptions& options);

/// ValueError for numbers that cannot be; an eighth is that of the threads.
IterativeOptions options_of(const Eigen::VectorXd& numbers);

} // namespace pydart2
