#include "state/blow_up.hpp"

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <sstream>

#include "dynamics/weightless.hpp"
#include "state/state_watch.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Skeleton;

constexpr const char* remedy
    = "take smaller time steps, gains or forces, and go on from world.reset() or a snapshot (world.set_blow_up(\"nan\") "
      "lets it read NaN instead)";

std::string needs_mass(const BodyNode& body)
{
  return "body '" + body.getName() + "' of skeleton '" + body.getSkeleton()->getName()
         + "' moves nothing that has inertia: give it, or a body below it, mass and inertia, or weld it";
}

/// The first in the order of steps; null if none.
const BodyNode* find_weightless_body(const WorldRecord& record)
{
  for (const auto& item : record.skeletons)
    if (const auto* body = item->skeleton->isMobile() ? weightless_body(*item->skeleton) : nullptr)
      return body;
  return nullptr;
}

const dart::dynamics::DegreeOfFreedom* find_fastest_dof(const WorldRecord& record)
{
  const dart::dynamics::DegreeOfFreedom* fastest = nullptr;
  for (const auto& item : record.skeletons)
    for (const auto* dof : item->skeleton->getDofs())
      if (fastest == nullptr || !(std::abs(dof->getVelocity()) <= std::abs(fastest->getVelocity())))
        fastest = dof;
  return fastest;
}

} // namespace

std::string text(double value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}

void blown_up(const Skeleton& skeleton, const std::string& where, const char* what, double value, double time)
{
  if (const auto* body = skeleton.isMobile() ? weightless_body(skeleton) : nullptr)
    throw BlowUp("the simulation blew up at t = " + text(time) + " s: " + needs_mass(*body) + "; " + remedy);
  throw BlowUp(
      "the simulation blew up at t = " + text(time) + " s: " + what + " of " + where + " in skeleton '" + skeleton.getName()
      + "' became " + text(value) + "; " + remedy);
}

void engine_failed(const WorldRecord& record, const std::string& error, const std::string& suspect)
{
  throw Error(
      Kind::simulation,
      "the simulation blew up at t = " + text(record.world->getTime() + record.world->getTimeStep()) + " s: " + error + "; "
          + suspect + "; " + remedy);
}

std::string suspect(const WorldRecord& record)
{
  if (const auto* body = find_weightless_body(record))
    return needs_mass(*body);
  const auto* fastest = find_fastest_dof(record);
  if (fastest == nullptr)
    return "no skeleton has a dof";
  return "the fastest dof is '" + fastest->getName() + "' of skeleton '" + fastest->getSkeleton()->getName() + "', at "
         + text(fastest->getVelocity());
}

std::vector<SkeletonRef> insane_or_suspect(const WorldRecord& record)
{
  std::vector<SkeletonRef> found;
  for (const auto& item : record.plan.others)
    if (!watch(*item).is_sane())
      found.push_back(item);
  if (const auto i = record.plan.free.find_insane(check::huge); i < record.plan.free.size())
    found.push_back(record.plan.owners[i]);
  if (!found.empty())
    return found;
  dart::dynamics::ConstSkeletonPtr suspect;
  if (const auto* body = find_weightless_body(record))
    suspect = body->getSkeleton();
  else if (const auto* fastest = find_fastest_dof(record))
    suspect = fastest->getSkeleton();
  for (const auto& item : record.skeletons)
    if (item->skeleton == suspect)
      found.push_back(item);
  return found;
}

} // namespace pydart2
