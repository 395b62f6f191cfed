#include "dynamics/link_tree.hpp"

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/GenericJoint.hpp>

#include "base/errors.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::Joint;

template <class Space>
bool find(const Joint& joint, JointNumbers& numbers)
{
  using Generic = dart::dynamics::GenericJoint<Space>;
  const auto* typed = dynamic_cast<const Generic*>(&joint);
  if (typed == nullptr)
    return false;
  numbers = {
      [](const Joint& j) { return static_cast<const Generic&>(j).getRelativeJacobianStatic().data(); },
      [](const Joint& j) { return static_cast<const Generic&>(j).getRelativeJacobianTimeDerivStatic().data(); },
      typed->getVelocitiesStatic().data()};
  return true;
}

JointNumbers numbers_of(const Joint& joint)
{
  using namespace dart::math;
  JointNumbers numbers;
  const bool found = joint.getNumDofs() == 0 || find<R1Space>(joint, numbers) || find<R2Space>(joint, numbers)
                     || find<R3Space>(joint, numbers) || find<SO3Space>(joint, numbers) || find<SE3Space>(joint, numbers);
  if (!found)
    throw Error(Kind::engine, "joint '" + joint.getName() + "' is a " + joint.getType() + ", which is not known here");
  return numbers;
}

} // namespace

SpatialInertia Link::inertia() const
{
  // DART's tensor is [[I, [h]], [[h]^T, m 1]].
  const Eigen::Matrix6d& tensor = body->getSpatialInertia();
  return {tensor(3, 3), {tensor(2, 4), tensor(0, 5), tensor(1, 3)}, tensor.topLeftCorner<3, 3>()};
}

Spatial Link::times_velocities(const Columns& columns) const
{
  Spatial sum{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (int k = 0; k < num_dofs; ++k)
    sum += {columns.col(k).head<3>() * numbers.velocities[k], columns.col(k).tail<3>() * numbers.velocities[k]};
  return sum;
}

Spatial Link::from_parent(const Spatial& motion) const
{
  const Eigen::Isometry3d& T = joint->getRelativeTransform();
  const auto turned = T.linear().transpose();
  return {turned * motion.angular, turned * (motion.linear + motion.angular.cross(T.translation()))};
}

Spatial Link::to_parent(const Spatial& force) const
{
  const Eigen::Isometry3d& T = joint->getRelativeTransform();
  const Eigen::Vector3d linear = T.linear() * force.linear;
  return {T.linear() * force.angular + T.translation().cross(linear), linear};
}

LinkTree::LinkTree(dart::dynamics::Skeleton& skeleton) : skeleton(skeleton)
{
  for (std::size_t tree = 0; tree < skeleton.getNumTrees(); ++tree)
    add(*skeleton.getRootBodyNode(tree), -1);
}

void LinkTree::add(dart::dynamics::BodyNode& body, int parent)
{
  const Joint& joint = *body.getParentJoint();
  const auto num_dofs = static_cast<int>(joint.getNumDofs());
  const int first_dof = num_dofs == 0 ? 0 : static_cast<int>(joint.getIndexInSkeleton(0));
  const auto index = static_cast<int>(links.size());
  links.push_back({&body, &joint, numbers_of(joint), parent, first_dof, num_dofs});
  for (std::size_t i = 0; i < body.getNumChildBodyNodes(); ++i)
    add(*body.getChildBodyNode(i), index);
}

} // namespace pydart2
