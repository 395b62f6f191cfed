#include "handles/targets.hpp"

#include "base/checks.hpp"

namespace pydart2 {

namespace {

void copy(const Eigen::VectorXd& values, Output& like)
{
  vector(like, values.size()) = values;
}

} // namespace

TargetsHandle::TargetsHandle(WorldRef world, SkeletonRef skeleton)
  : skeleton_(std::move(world), skeleton, skeleton->skeleton.get())
{
}

void TargetsHandle::set(
    const VectorIn& q, const VectorIn& dq, const VectorIn& kp, const VectorIn& kd, long compensation)
{
  const auto n = skeleton_->getNumDofs();
  for (const auto* values : {&q, &dq, &kp, &kd}) {
    check::size(values->size, n, "targets and gains");
    check::finite(*values, "targets and gains");
  }
  for (long i = 0; i < kp.size; ++i) {
    check::not_negative(kp.data[i], "kp");
    check::not_negative(kd.data[i], "kd");
  }
  Targets targets(static_cast<long>(n));
  targets.q = q.eigen();
  targets.dq = dq.eigen();
  targets.kp = kp.eigen();
  targets.kd = kd.eigen();
  targets.compensation = static_cast<Targets::Compensation>(check::index(compensation, 3, "compensation"));
  skeleton_.skeleton->motors.set(targets);
}

void TargetsHandle::clear()
{
  skeleton_.get();
  skeleton_.skeleton->motors.clear();
}

bool TargetsHandle::any() const
{
  return targets().any();
}

Targets TargetsHandle::targets() const
{
  const auto& motors = skeleton_.skeleton->motors;
  return motors.targets() ? *motors.targets() : Targets(static_cast<long>(skeleton_->getNumDofs()));
}

void TargetsHandle::q(Output& like) const
{
  copy(targets().q, like);
}

void TargetsHandle::dq(Output& like) const
{
  copy(targets().dq, like);
}

void TargetsHandle::kp(Output& like) const
{
  copy(targets().kp, like);
}

void TargetsHandle::kd(Output& like) const
{
  copy(targets().kd, like);
}

int TargetsHandle::compensation() const
{
  return static_cast<int>(targets().compensation);
}

void TargetsHandle::forces(Output& like) const
{
  const auto n = static_cast<long>(skeleton_->getNumDofs());
  const auto& forces = skeleton_.skeleton->motors.forces();
  copy(forces.size() == n ? forces : Eigen::VectorXd(Eigen::VectorXd::Zero(n)), like);
}

} // namespace pydart2
