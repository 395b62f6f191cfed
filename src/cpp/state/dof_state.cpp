#include "state/dof_state.hpp"

#include <algorithm>
#include <limits>
#include <cstring>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/GenericJoint.hpp>

#include "base/errors.hpp"

namespace pydart2 {

namespace {

struct Address
{
  const double *position, *velocity, *acceleration, *force;
  bool (*at_rest)(const dart::dynamics::Joint&);
};

/// Whether the commands of a joint are zero, and zero is within what clips a command.
template <class Space>
bool at_rest(const dart::dynamics::Joint& joint)
{
  using Generic = dart::dynamics::GenericJoint<Space>;
  static const typename Generic::Vector zero = Generic::Vector::Zero();
  const auto& typed = static_cast<const Generic&>(joint);
  const auto& commands = typed.getAspectState().mCommands;
  const auto& limits = typed.Generic::Base::getAspectProperties();
  const auto spans = [](const auto& lower, const auto& upper) {
    return (lower.array() <= 0.0).all() && (upper.array() >= 0.0).all();
  };
  return std::memcmp(commands.data(), zero.data(), sizeof zero) == 0 // -0 is not at rest
         && spans(limits.mForceLowerLimits, limits.mForceUpperLimits)
         && spans(limits.mVelocityLowerLimits, limits.mVelocityUpperLimits)
         && spans(limits.mAccelerationLowerLimits, limits.mAccelerationUpperLimits);
}

/// The addresses of the i-th dof of a joint, if the joint is over the given configuration space.
template <class Space>
bool find(const dart::dynamics::Joint& joint, std::size_t i, Address& address)
{
  const auto* typed = dynamic_cast<const dart::dynamics::GenericJoint<Space>*>(&joint);
  if (typed == nullptr)
    return false;
  address = {
      typed->getPositionsStatic().data() + i,
      typed->getVelocitiesStatic().data() + i,
      typed->getAccelerationsStatic().data() + i,
      typed->getAspectState().mForces.data() + i,
      at_rest<Space>};
  return true;
}

} // namespace

DofState::DofState(const dart::dynamics::Skeleton& skeleton)
{
  using namespace dart::math;
  for (const auto* dof : skeleton.getDofs()) {
    const auto& joint = *dof->getJoint();
    const auto i = dof->getIndexInJoint();
    Address address;
    const bool found = find<R1Space>(joint, i, address) || find<R2Space>(joint, i, address)
                       || find<R3Space>(joint, i, address) || find<SO3Space>(joint, i, address)
                       || find<SE3Space>(joint, i, address);
    if (!found)
      throw Error(Kind::engine, "joint '" + joint.getName() + "' is a " + joint.getType() + ", which is not known here");
    positions.push_back(address.position);
    velocities.push_back(address.velocity);
    accelerations.push_back(address.acceleration);
    forces.push_back(address.force);
    if (i == 0)
      joints_.push_back({&joint, address.at_rest});
  }
}

void DofState::become_not_numbers()
{
  static const double nan = std::numeric_limits<double>::quiet_NaN();
  for (auto* places : {&positions, &velocities, &accelerations})
    places->assign(places->size(), &nan);
}

bool DofState::commands_at_rest() const
{
  return std::all_of(joints_.begin(), joints_.end(), [](const auto& entry) { return entry.at_rest(*entry.joint); });
}

} // namespace pydart2
