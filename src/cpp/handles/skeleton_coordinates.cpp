// q, dq, ddq, forces, commands and limits of a skeleton.

#include <algorithm>

#include "base/checks.hpp"
#include "handles/skeleton.hpp"

namespace pydart2 {

using dart::dynamics::DegreeOfFreedom;

void SkeletonHandle::gather(const std::vector<const double*>& places, Output& out) const
{
  skeleton_.get();
  double* value = out.vector(static_cast<long>(places.size()));
  for (const double* place : places)
    *value++ = *place;
}

template <class Read>
void SkeletonHandle::each_dof(Output& out, Read read) const
{
  const auto& dofs = this->dofs();
  double* value = out.vector(static_cast<long>(dofs.size()));
  for (const DegreeOfFreedom* dof : dofs)
    *value++ = read(*dof);
}

const Eigen::VectorXd& SkeletonHandle::per_dof(const VectorIn& values, const char* what)
{
  const auto& dofs = std::as_const(*this).dofs();
  if (values.size + 6 == static_cast<long>(dofs.size()) && dofs.front()->getJoint()->getNumDofs() == 6) {
    const auto of_a_base = std::string(what) + " (the first 6 are of the base, which floats; base=\"fixed\" welds it)";
    check::size(values.size, dofs.size(), of_a_base.c_str());
  }
  check::size(values.size, dofs.size(), what);
  check::finite(values, what);
  scratch_ = values.eigen();
  return scratch_;
}

const DofState& SkeletonHandle::state() const
{
  return skeleton_.skeleton->dofs();
}

void SkeletonHandle::positions(Output& like) const
{
  gather(state().positions, like);
}

void SkeletonHandle::velocities(Output& like) const
{
  gather(state().velocities, like);
}

void SkeletonHandle::accelerations(Output& like) const
{
  gather(state().accelerations, like);
}

void SkeletonHandle::forces(Output& like) const
{
  gather(state().forces, like);
}

void SkeletonHandle::last_forces(Output& like) const
{
  skeleton_.get();
  const auto& forces = skeleton_.skeleton->last_forces();
  vector(like, forces.size()) = forces;
}

void SkeletonHandle::set_last_forces(const VectorIn& forces)
{
  skeleton_.skeleton->last_forces() = per_dof(forces, "forces");
}

void SkeletonHandle::commands(Output& like) const
{
  each_dof(like, [](const DegreeOfFreedom& dof) { return dof.getCommand(); });
}

void SkeletonHandle::set_positions(const VectorIn& positions)
{
  // Joint by joint; a method of dart::dynamics::Skeleton would make every dof a change of its own.
  const auto& values = per_dof(positions, "positions");
  skeleton_.world->become_numbers(*skeleton_.skeleton);
  const auto& dofs = this->dofs();
  for (std::size_t i = 0; i < dofs.size();) {
    auto& joint = *dofs[i]->getJoint();
    const auto size = joint.getNumDofs();
    if (size == 1)
      joint.setPosition(0, values[static_cast<long>(i)]);
    else {
      auto& of_joint = joint_scratch_[size];
      of_joint = values.segment(static_cast<long>(i), static_cast<long>(size));
      joint.setPositions(of_joint);
    }
    i += size;
  }
}

void SkeletonHandle::set_velocities(const VectorIn& velocities)
{
  skeleton().setVelocities(per_dof(velocities, "velocities"));
}

void SkeletonHandle::set_accelerations(const VectorIn& accelerations)
{
  skeleton().setAccelerations(per_dof(accelerations, "accelerations"));
}

void SkeletonHandle::set_forces(const VectorIn& forces)
{
  if (skeleton_.skeleton->not_numbers) // nothing moves, and what a controller makes of NaN is NaN
    return;
  const auto& values = per_dof(forces, "forces");
  skeleton_.skeleton->last_forces() = values;
  const auto& dofs = skeleton_.get_to_push(!values.isZero(0.0))->getDofs();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    dofs[i]->setForce(values[static_cast<long>(i)]);
}

void SkeletonHandle::set_commands(const VectorIn& commands)
{
  if (skeleton_.skeleton->not_numbers)
    return;
  const auto& values = per_dof(commands, "commands");
  skeleton_.get_to_push(!values.isZero(0.0))->setCommands(values);
}

void SkeletonHandle::states(Output& into) const
{
  double* value = into.vector(2 * static_cast<long>(dofs().size()));
  const auto& from = state();
  for (const auto* places : {&from.positions, &from.velocities})
    for (const double* place : *places)
      *value++ = *place;
}

void SkeletonHandle::set_states(const VectorIn& states)
{
  auto& skel = skeleton();
  check::size(states.size, 2 * dofs().size(), "states [q, dq]");
  check::finite(states, "states");
  skeleton_.world->become_numbers(*skeleton_.skeleton);
  skel.setPositions(states.eigen().head(states.size / 2));
  skel.setVelocities(states.eigen().tail(states.size / 2));
}

void SkeletonHandle::position_differences(const VectorIn& q1, const VectorIn& q2, Output& out) const
{
  auto& skel = skeleton();
  for (const auto* q : {&q1, &q2}) {
    check::size(q->size, dofs().size(), "positions");
    check::finite(*q, "positions");
  }
  const Eigen::VectorXd values = skel.getPositionDifferences(q1.eigen(), q2.eigen());
  vector(out, values.size()) = values;
}

void SkeletonHandle::integrate_positions(const VectorIn& q, const VectorIn& velocities, Output& out) const
{
  auto& skel = skeleton();
  for (const auto* numbers : {&q, &velocities}) {
    check::size(numbers->size, dofs().size(), "positions and velocities");
    check::finite(*numbers, "positions and velocities");
  }
  const Eigen::VectorXd before = skel.getPositions(), rates = skel.getVelocities();
  skel.setPositions(q.eigen());
  skel.setVelocities(velocities.eigen());
  skel.integratePositions(1.0);
  const Eigen::VectorXd values = skel.getPositions();
  vector(out, values.size()) = values;
  skel.setPositions(before);
  skel.setVelocities(rates);
}

void SkeletonHandle::velocity_differences(const VectorIn& dq1, const VectorIn& dq2, Output& out) const
{
  auto& skel = skeleton();
  for (const auto* dq : {&dq1, &dq2}) {
    check::size(dq->size, dofs().size(), "velocities");
    check::finite(*dq, "velocities");
  }
  const Eigen::VectorXd values = skel.getVelocityDifferences(dq1.eigen(), dq2.eigen());
  vector(out, values.size()) = values;
}

void SkeletonHandle::position_lower_limits(Output& out) const
{
  each_dof(out, [](const DegreeOfFreedom& dof) { return dof.getPositionLowerLimit(); });
}

void SkeletonHandle::position_upper_limits(Output& out) const
{
  each_dof(out, [](const DegreeOfFreedom& dof) { return dof.getPositionUpperLimit(); });
}

void SkeletonHandle::force_lower_limits(Output& out) const
{
  each_dof(out, [](const DegreeOfFreedom& dof) { return dof.getForceLowerLimit(); });
}

void SkeletonHandle::force_upper_limits(Output& out) const
{
  each_dof(out, [](const DegreeOfFreedom& dof) { return dof.getForceUpperLimit(); });
}

} // namespace pydart2
