#include "dof_state.hpp"

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/GenericJoint.hpp>

#include "errors.hpp"

namespace pydart2 {

namespace {

struct Address
{
  const double *position, *velocity, *acceleration;
};

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
      typed->getAccelerationsStatic().data() + i};
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
  }
}

} // namespace pydart2
