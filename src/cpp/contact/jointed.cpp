#include "contact/jointed.hpp"

#include <dart/constraint/JointConstraint.hpp>
#include <dart/constraint/JointCoulombFrictionConstraint.hpp>
#include <dart/constraint/MimicMotorConstraint.hpp>

namespace pydart2 {

namespace {

using dart::constraint::ConstraintBasePtr;
using dart::dynamics::Joint;

bool has_dry_friction(const Joint& joint)
{
  for (std::size_t dof = 0; dof < joint.getNumDofs(); ++dof)
    if (joint.getCoulombFriction(dof) != 0.0)
      return true;
  return false;
}

bool may_have_constraints(const Joint& joint)
{
  const auto actuator = joint.getActuatorType();
  const bool any = joint.areLimitsEnforced() || actuator == Joint::SERVO || actuator == Joint::MIMIC;
  return !joint.isKinematic() && (any || has_dry_friction(joint));
}

} // namespace

void Jointed::look_at(const std::vector<dart::dynamics::SkeletonPtr>& all)
{
  skeletons.clear();
  joints.clear();
  for (const auto& skeleton : all) {
    const auto before = joints.size();
    for (auto* joint : skeleton->getJoints())
      if (may_have_constraints(*joint))
        joints.push_back(joint);
    if (joints.size() > before)
      skeletons.push_back(skeleton);
  }
}

std::vector<ConstraintBasePtr> Jointed::make_constraints() const
{
  using namespace dart::constraint;
  std::vector<ConstraintBasePtr> made;
  for (auto* joint : joints)
    if (joint->areLimitsEnforced() || joint->getActuatorType() == Joint::SERVO)
      made.push_back(std::make_shared<JointConstraint>(joint));
  for (auto* joint : joints)
    if (joint->getActuatorType() == Joint::MIMIC && joint->getMimicJoint() != nullptr)
      made.push_back(std::make_shared<MimicMotorConstraint>(
          joint, joint->getMimicJoint(), joint->getMimicMultiplier(), joint->getMimicOffset()));
  for (auto* joint : joints)
    if (has_dry_friction(*joint))
      made.push_back(std::make_shared<JointCoulombFrictionConstraint>(joint));
  return made;
}

} // namespace pydart2
