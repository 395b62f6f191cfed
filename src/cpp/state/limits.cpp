#include "state/limits.hpp"

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/Joint.hpp>
#include <sstream>

#include "base/errors.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::DegreeOfFreedom;
using dart::dynamics::Joint;

void check(const DegreeOfFreedom& dof, const char* what, double lower, double upper)
{
  if (lower <= upper)
    return;
  std::ostringstream text;
  text << "dof '" << dof.getName() << "' of skeleton '" << dof.getSkeleton()->getName() << "' has a lower " << what
       << " limit of " << lower << " above the upper one of " << upper
       << ", and its joint acts on them; set them the right way round, or set_position_limit_enforced(False)";
  throw Error(Kind::simulation, text.str());
}

void check(const Joint& joint)
{
  const auto actuator = joint.getActuatorType();
  const bool servo = actuator == Joint::SERVO;
  for (std::size_t i = 0; i < joint.getNumDofs(); ++i) {
    const auto& dof = *joint.getDof(i);
    if (servo || joint.areLimitsEnforced()) {
      check(dof, "position", dof.getPositionLowerLimit(), dof.getPositionUpperLimit());
      check(dof, "velocity", dof.getVelocityLowerLimit(), dof.getVelocityUpperLimit());
    }
    if (servo || actuator == Joint::MIMIC)
      check(dof, "force", dof.getForceLowerLimit(), dof.getForceUpperLimit());
  }
}

} // namespace

void check_limits(WorldRecord& world)
{
  for (const auto& item : world.awake()) {
    if (item->limits_checked)
      continue;
    for (const auto* joint : item->skeleton->getJoints())
      check(*joint);
    item->limits_checked = true;
  }
}

} // namespace pydart2
