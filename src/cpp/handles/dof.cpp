#include "handles/dof.hpp"

#include <limits>

#include "base/checks.hpp"

namespace pydart2 {

namespace {

/// The engine does not see that what opposes a motion, and so the articulated inertia, has changed until the robot moves.
void forget_inertia(dart::dynamics::DegreeOfFreedom& dof)
{
  dof.getSkeleton()->dirtyArticulatedInertia(dof.getTreeIndex());
}

} // namespace

DofHandle::DofHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::DegreeOfFreedom* dof)
  : dof_(std::move(world), std::move(skeleton), dof)
{
}

std::string DofHandle::name() const
{
  return dof_->getName();
}

int DofHandle::index_in_skeleton() const
{
  return static_cast<int>(dof_->getIndexInSkeleton());
}

int DofHandle::index_in_tree() const
{
  return static_cast<int>(dof_->getIndexInTree());
}

int DofHandle::index_in_joint() const
{
  return static_cast<int>(dof_->getIndexInJoint());
}

int DofHandle::tree_index() const
{
  return static_cast<int>(dof_->getTreeIndex());
}

double DofHandle::position() const
{
  const auto& dof = *dof_; // throws if it is gone
  return dof_.skeleton->not_numbers ? std::numeric_limits<double>::quiet_NaN() : dof.getPosition();
}

void DofHandle::set_position(double position)
{
  check::finite(position, "position");
  dof_->setPosition(position);
}

double DofHandle::initial_position() const
{
  return dof_->getInitialPosition();
}

void DofHandle::set_initial_position(double position)
{
  check::finite(position, "initial position");
  dof_->setInitialPosition(position);
}

bool DofHandle::has_position_limit() const
{
  return dof_->hasPositionLimit();
}

double DofHandle::position_lower_limit() const
{
  return dof_->getPositionLowerLimit();
}

void DofHandle::set_position_lower_limit(double limit)
{
  check::lower_limit(limit, "lower position limit");
  dof_->setPositionLowerLimit(limit);
  dof_.skeleton->limits_checked = false;
}

double DofHandle::position_upper_limit() const
{
  return dof_->getPositionUpperLimit();
}

void DofHandle::set_position_upper_limit(double limit)
{
  check::upper_limit(limit, "upper position limit");
  dof_->setPositionUpperLimit(limit);
  dof_.skeleton->limits_checked = false;
}

double DofHandle::velocity() const
{
  const auto& dof = *dof_;
  return dof_.skeleton->not_numbers ? std::numeric_limits<double>::quiet_NaN() : dof.getVelocity();
}

void DofHandle::set_velocity(double velocity)
{
  check::finite(velocity, "velocity");
  dof_->setVelocity(velocity);
}

double DofHandle::initial_velocity() const
{
  return dof_->getInitialVelocity();
}

void DofHandle::set_initial_velocity(double velocity)
{
  check::finite(velocity, "initial velocity");
  dof_->setInitialVelocity(velocity);
}

double DofHandle::velocity_lower_limit() const
{
  return dof_->getVelocityLowerLimit();
}

void DofHandle::set_velocity_lower_limit(double limit)
{
  check::lower_limit(limit, "lower velocity limit");
  dof_->setVelocityLowerLimit(limit);
  dof_.skeleton->limits_checked = false;
}

double DofHandle::velocity_upper_limit() const
{
  return dof_->getVelocityUpperLimit();
}

void DofHandle::set_velocity_upper_limit(double limit)
{
  check::upper_limit(limit, "upper velocity limit");
  dof_->setVelocityUpperLimit(limit);
  dof_.skeleton->limits_checked = false;
}

double DofHandle::acceleration() const
{
  return dof_->getAcceleration();
}

void DofHandle::set_acceleration(double acceleration)
{
  check::finite(acceleration, "acceleration");
  dof_->setAcceleration(acceleration);
}

double DofHandle::force() const
{
  return dof_->getForce();
}

void DofHandle::set_force(double force)
{
  check::finite(force, "force");
  dof_.get_to_push(force != 0.0)->setForce(force);
}

double DofHandle::force_lower_limit() const
{
  return dof_->getForceLowerLimit();
}

void DofHandle::set_force_lower_limit(double limit)
{
  check::lower_limit(limit, "lower force limit");
  dof_->setForceLowerLimit(limit);
  dof_.skeleton->limits_checked = false;
}

double DofHandle::force_upper_limit() const
{
  return dof_->getForceUpperLimit();
}

void DofHandle::set_force_upper_limit(double limit)
{
  check::upper_limit(limit, "upper force limit");
  dof_->setForceUpperLimit(limit);
  dof_.skeleton->limits_checked = false;
}

double DofHandle::command() const
{
  return dof_->getCommand();
}

void DofHandle::set_command(double command)
{
  check::finite(command, "command");
  dof_.get_to_push(command != 0.0)->setCommand(command);
}

double DofHandle::spring_stiffness() const
{
  return dof_->getSpringStiffness();
}

void DofHandle::set_spring_stiffness(double stiffness)
{
  check::not_negative(stiffness, "spring stiffness");
  dof_->setSpringStiffness(stiffness);
  forget_inertia(*dof_);
}

double DofHandle::rest_position() const
{
  return dof_->getRestPosition();
}

void DofHandle::set_rest_position(double position)
{
  check::finite(position, "rest position");
  dof_->setRestPosition(position);
}

double DofHandle::damping_coefficient() const
{
  return dof_->getDampingCoefficient();
}

void DofHandle::set_damping_coefficient(double coefficient)
{
  check::not_negative(coefficient, "damping coefficient");
  dof_->setDampingCoefficient(coefficient);
  forget_inertia(*dof_);
}

double DofHandle::armature() const
{
  auto* dof = dof_.get();
  const auto& armature = dof_.skeleton->armature;
  const auto found = armature.find(dof);
  return found == armature.end() ? 0.0 : found->second;
}

void DofHandle::set_armature(double inertia)
{
  check::not_negative(inertia, "armature");
  auto* dof = dof_.get();
  if (inertia > 0.0)
    dof_.skeleton->armature[dof] = inertia;
  else
    dof_.skeleton->armature.erase(dof);
  forget_inertia(*dof);
}

double DofHandle::coulomb_friction() const
{
  return dof_->getCoulombFriction();
}

void DofHandle::set_coulomb_friction(double friction)
{
  check::not_negative(friction, "Coulomb friction");
  dof_->setCoulombFriction(friction);
}

double DofHandle::constraint_impulse() const
{
  return dof_->getConstraintImpulse();
}

void DofHandle::set_constraint_impulse(double impulse)
{
  check::finite(impulse, "constraint impulse");
  dof_->setConstraintImpulse(impulse);
}

} // namespace pydart2
