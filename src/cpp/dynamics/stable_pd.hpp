#pragma once

#include <optional>

#include "dynamics/armature.hpp"
#include "dynamics/bias_forces.hpp"
#include "dynamics/mass_matrix.hpp"

namespace pydart2 {

/// Where the motors of a skeleton should take it; a dof without gains has no motor.
struct Targets
{
  enum class Compensation { none, gravity, bias };

  explicit Targets(long num_dofs);

  Eigen::VectorXd q, dq, kp, kd;
  Compensation compensation = Compensation::none;

  bool any() const { return (kp.array() != 0).any() || (kd.array() != 0).any(); }
};

/// PD control inside the step, implicit in both gains: Tan, Liu, Turk, "Stable Proportional-Derivative Controllers",
/// IEEE CG&A 31(4), 2011. The motors' forces are those at the end of a step of length h,
///
///   tau = kp (q* - q - h q' - h^2 q'') + kd (q'* - q' - h q'') + compensation,
///
/// with the q'' that follows from them, from the springs and dampers of the joints (D, K, implicit as the engine has
/// them), from what else acts on the dofs and from what contacts and limits did in the last step,
///
///   (M + A + h (D + kd) + h^2 (K + kp)) q'' = tau at q'' = 0 + others - c - D q' - K (q + h q' - rest),
///
/// with A the armature. A motor beyond its effort limit has that force, and the others are computed again. Differences of
/// ball and free joints are those of the engine's log map.
class StablePd
{
public:
  explicit StablePd(dart::dynamics::Skeleton& skeleton);

  /// Adds the motors' forces to those of the dofs for the next step; `forces` has them alone.
  void act(const Targets& targets, const Armature& armature, double h);

  const Eigen::VectorXd& forces() const { return forces_; }

private:
  Eigen::VectorXd compensation(const Targets& targets);
  Eigen::VectorXd others(double h);
  bool hold_at_limits(Eigen::VectorXd& held);

  LinkTree tree_;
  MassMatrix mass_matrix_;
  BiasForces bias_forces_;
  Eigen::VectorXd stiffness_, damping_, rest_, lower_, upper_; ///< Of the dofs.
  Eigen::VectorXd kp_, kd_, forces_;
};

/// The targets of a skeleton, if it has any, and what follows them.
class Motors
{
public:
  const std::optional<Targets>& targets() const { return targets_; }
  void set(const Targets& targets);
  void clear();

  /// Before a step of length h.
  void act(dart::dynamics::Skeleton& skeleton, const Armature& armature, double h);

  /// Of the last step; empty if no motor was there.
  const Eigen::VectorXd& forces() const;

private:
  std::optional<Targets> targets_;
  std::optional<StablePd> control_;
};

} // namespace pydart2
