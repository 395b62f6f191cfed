#include "dynamics/armature.hpp"

#include <dart/dynamics/Joint.hpp>

namespace pydart2 {

using dart::dynamics::Joint;

WithArmature::WithArmature(const Armature& armature, double time_step)
{
  for (const auto& [dof, inertia] : armature) {
    auto& joint = *dof->getJoint();
    if (joint.isKinematic()) // its motion is given
      continue;
    before_.push_back({dof, joint.getActuatorType(), dof->getDampingCoefficient(), dof->getForce(), dof->getCommand()});
    // The engine takes the command for the force, and no force of others: a servo's is a constraint.
    const double force = joint.getActuatorType() == Joint::FORCE ? dof->getCommand() : 0.0;
    dof->setDampingCoefficient(before_.back().damping + inertia / time_step);
    joint.setActuatorType(Joint::FORCE);
    dof->setForce(force + inertia / time_step * dof->getVelocity());
  }
}

WithArmature::~WithArmature()
{
  for (auto one = before_.rbegin(); one != before_.rend(); ++one) {
    one->dof->setDampingCoefficient(one->damping);
    one->dof->setForce(one->force);
    one->dof->getJoint()->setActuatorType(one->actuator);
    one->dof->setCommand(one->command);
  }
}

} // namespace pydart2
