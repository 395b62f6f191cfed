#include "dynamics/armature.hpp"

#include <dart/dynamics/GenericJoint.hpp>

#include "engine/tree_members.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::GenericJoint;
using dart::dynamics::Joint;

/// Of the dofs of a joint with a configuration space; false if that is not the joint's.
template <class Space>
bool add_to(Joint& joint, const BodyNode& body, const Armature& armature, double dt)
{
  auto* typed = dynamic_cast<GenericJoint<Space>*>(&joint);
  if (typed == nullptr)
    return false;
  typename Space::Vector own, implicit;
  for (std::size_t i = 0; i < Space::NumDofs; ++i) {
    const auto found = armature.find(typed->getDof(i));
    own[static_cast<long>(i)] = found == armature.end() ? 0.0 : found->second;
    implicit[static_cast<long>(i)] = dt * typed->getDampingCoefficient(i) + dt * dt * typed->getSpringStiffness(i);
  }
  if ((own.array() == 0.0).all())
    return true;
  const auto& J = typed->getRelativeJacobianStatic();
  using Members = engine::GenericJointMembers<Space>;
  typename Space::Matrix projected = J.transpose() * body.*engine::BodyMembers::inertia * J;
  projected += own.asDiagonal();
  typed->*Members::inverse_inertia = dart::math::inverse<Space>(projected);
  projected = J.transpose() * body.*engine::BodyMembers::inertia_implicit * J;
  projected += (own + implicit).asDiagonal();
  typed->*Members::inverse_inertia_implicit = dart::math::inverse<Space>(projected);
  return true;
}

/// Does what add_to() does for the space that is the joint's.
template <class... Spaces>
void add_to_any(Joint& joint, const BodyNode& body, const Armature& armature, double dt)
{
  static_cast<void>((add_to<Spaces>(joint, body, armature, dt) || ...));
}

} // namespace

void put_into_inertias(const Armature& armature, dart::dynamics::Skeleton& skeleton)
{
  if (armature.empty())
    return;
  using namespace dart::math;
  const double dt = skeleton.getTimeStep();
  for (std::size_t tree = 0; tree < skeleton.getNumTrees(); ++tree) {
    const auto& bodies = skeleton.getTreeBodyNodes(tree); // parents first
    for (auto one = bodies.rbegin(); one != bodies.rend(); ++one) {
      BodyNode& body = **one;
      Joint& joint = *body.getParentJoint();
      (body.*engine::BodyMembers::update_inertia)(dt);
      if (!joint.isKinematic()) // its motion is given
        add_to_any<R1Space, R2Space, R3Space, SO3Space, SE3Space>(joint, body, armature, dt);
    }
    engine::SkeletonMembers::tree(skeleton, tree).mArticulatedInertia = false;
  }
}

} // namespace pydart2
