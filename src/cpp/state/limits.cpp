#include "state/limits.hpp"

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/Joint.hpp>
#include <cmath>
#include <dart/common/Console.hpp>
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

bool turns(const Joint& joint)
{
  const auto& type = joint.getType();
  return type != "PrismaticJoint" && type != "TranslationalJoint" && type != "TranslationalJoint2D";
}

void look_for_limits(SkeletonRecord& item)
{
  item.far_beyond.clear();
  const auto& dofs = item.skeleton->getDofs();
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto& dof = *dofs[i];
    const double lower = dof.getPositionLowerLimit(), upper = dof.getPositionUpperLimit();
    const bool acts = dof.getJoint()->areLimitsEnforced() || dof.getJoint()->getActuatorType() == Joint::SERVO;
    if (acts || !(std::isfinite(lower) && std::isfinite(upper) && lower < upper))
      continue;
    const double far = turns(*dof.getJoint()) ? 2.0 * M_PI : upper - lower;
    item.far_beyond.push_back({i, lower - far, upper + far});
  }
}

void tell(const DegreeOfFreedom& dof)
{
  const bool turning = turns(*dof.getJoint());
  dtwarn << "[World] dof '" << dof.getName() << "' of skeleton '" << dof.getSkeleton()->getName() << "' is "
         << (turning ? "a turn" : "the length of its range") << " beyond its limits of " << dof.getPositionLowerLimit()
         << " and " << dof.getPositionUpperLimit() << (turning ? " rad" : " m")
         << ", which do not act: skel.set_position_limits_enforced(True) lets those of all its joints act\n";
}

} // namespace

void tell_of_limits(const WorldRecord& world)
{
  for (const auto& item : world.plan.others) {
    if (item->far_beyond.empty())
      continue;
    const auto& places = item->dofs().positions;
    for (const auto& [dof, low, high] : item->far_beyond)
      if (const double q = *places[dof]; q < low || q > high) {
        tell(*item->skeleton->getDof(dof));
        item->far_beyond.clear();
        item->told_of_limits = true;
        break;
      }
  }
}

void check_limits(WorldRecord& world)
{
  for (const auto& item : world.plan.others) {
    if (item->limits_checked)
      continue;
    for (const auto* joint : item->skeleton->getJoints())
      check(*joint);
    if (!item->told_of_limits)
      look_for_limits(*item);
    item->limits_checked = true;
  }
}

} // namespace pydart2
