#include "dynamics/stable_pd.hpp"

#include "dynamics/each_dof.hpp"

namespace pydart2 {

Targets::Targets(long num_dofs)
  : q(Eigen::VectorXd::Zero(num_dofs)),
    dq(Eigen::VectorXd::Zero(num_dofs)),
    kp(Eigen::VectorXd::Zero(num_dofs)),
    kd(Eigen::VectorXd::Zero(num_dofs))
{
}

StablePd::StablePd(dart::dynamics::Skeleton& skeleton) : tree_(skeleton) {}

/// What the motors hold before they look at their targets.
Eigen::VectorXd StablePd::compensation(const Targets& targets)
{
  if (targets.compensation == Targets::Compensation::none)
    return Eigen::VectorXd::Zero(targets.q.size());
  const Eigen::VectorXd c = targets.compensation == Targets::Compensation::bias ? bias_forces_.compute(tree_)
                                                                               : gravity_forces(tree_.skeleton);
  return (targets.kp.array() != 0 || targets.kd.array() != 0).select(c, 0.0);
}

/// What moves the dofs without the motors.
Eigen::VectorXd StablePd::others(double h)
{
  const auto& skeleton = tree_.skeleton;
  const Eigen::VectorXd dq = skeleton.getVelocities();
  return skeleton.getForces() + skeleton.getExternalForces() + constraint_forces(skeleton) - bias_forces_.compute(tree_)
         - damping_.cwiseProduct(dq) - stiffness_.cwiseProduct(skeleton.getPositions() + h * dq - rest_);
}

/// Gives the motors beyond their limits the force of the limit, for good; true if there were any.
bool StablePd::hold_at_limits(Eigen::VectorXd& held)
{
  bool any = false;
  for (long i = 0; i < forces_.size(); ++i)
    if ((kp_[i] != 0 || kd_[i] != 0) && (forces_[i] < lower_[i] || forces_[i] > upper_[i])) {
      held[i] = forces_[i] < lower_[i] ? lower_[i] : upper_[i];
      kp_[i] = kd_[i] = 0;
      any = true;
    }
  return any;
}

void StablePd::act(const Targets& targets, const Armature& armature, double h)
{
  using Dof = dart::dynamics::DegreeOfFreedom;
  auto& skeleton = tree_.skeleton;
  stiffness_ = each_dof(skeleton, [](const Dof& dof) { return dof.getSpringStiffness(); });
  damping_ = each_dof(skeleton, [](const Dof& dof) { return dof.getDampingCoefficient(); });
  rest_ = each_dof(skeleton, [](const Dof& dof) { return dof.getRestPosition(); });
  lower_ = skeleton.getForceLowerLimits();
  upper_ = skeleton.getForceUpperLimits();
  kp_ = targets.kp;
  kd_ = targets.kd;
  const Eigen::VectorXd dq = skeleton.getVelocities();
  const Eigen::VectorXd error = skeleton.getPositionDifferences(targets.q, skeleton.getPositions()) - h * dq;
  const Eigen::VectorXd at_rest = targets.kp.cwiseProduct(error) + targets.kd.cwiseProduct(targets.dq - dq)
                                  + compensation(targets);
  const Eigen::VectorXd others = this->others(h);
  Eigen::MatrixXd M = mass_matrix_.update(tree_);
  for (const auto& [dof, inertia] : armature) {
    const auto i = static_cast<long>(dof->getIndexInSkeleton());
    M(i, i) += inertia;
  }
  Eigen::VectorXd held = at_rest; // where the gains are not zero, what the motors do at q'' = 0
  do {
    Eigen::MatrixXd A = M;
    A.diagonal() += h * (damping_ + kd_) + h * h * (stiffness_ + kp_);
    const Eigen::VectorXd ddq = A.ldlt().solve(held + others);
    forces_ = held - (h * kd_ + h * h * kp_).cwiseProduct(ddq);
  } while (hold_at_limits(held));
  for (long i = 0; i < forces_.size(); ++i)
    if (auto* dof = skeleton.getDof(static_cast<std::size_t>(i)); forces_[i] != 0)
      dof->setForce(dof->getForce() + forces_[i]);
}

void Motors::set(const Targets& targets)
{
  targets_ = targets;
}

void Motors::clear()
{
  targets_.reset();
  control_.reset();
}

void Motors::act(dart::dynamics::Skeleton& skeleton, const Armature& armature, double h)
{
  if (!targets_)
    return;
  if (!control_)
    control_.emplace(skeleton);
  control_->act(*targets_, armature, h);
}

const Eigen::VectorXd& Motors::forces() const
{
  static const Eigen::VectorXd none;
  return control_ ? control_->forces() : none;
}

} // namespace pydart2
