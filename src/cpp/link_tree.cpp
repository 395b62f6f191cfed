#include "link_tree.hpp"

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/GenericJoint.hpp>

#include "errors.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::Joint;

template <class Space>
const double* columns_of(const Joint& joint)
{
  return static_cast<const dart::dynamics::GenericJoint<Space>&>(joint).getRelativeJacobianStatic().data();
}

template <class Space>
bool is_over(const Joint& joint)
{
  return dynamic_cast<const dart::dynamics::GenericJoint<Space>*>(&joint) != nullptr;
}

/// How to get at the Jacobian of a joint of this type without an allocation. The engine updates it when it is read.
auto columns_reader(const Joint& joint) -> const double* (*)(const Joint&)
{
  using namespace dart::math;
  if (joint.getNumDofs() == 0)
    return nullptr;
  if (is_over<R1Space>(joint))
    return columns_of<R1Space>;
  if (is_over<R2Space>(joint))
    return columns_of<R2Space>;
  if (is_over<R3Space>(joint))
    return columns_of<R3Space>;
  if (is_over<SO3Space>(joint))
    return columns_of<SO3Space>;
  if (is_over<SE3Space>(joint))
    return columns_of<SE3Space>;
  throw Error(Kind::engine, "joint '" + joint.getName() + "' is a " + joint.getType() + ", which is not known here");
}

} // namespace

SpatialInertia Link::inertia() const
{
  // DART's tensor is [[I, [h]], [[h]^T, m 1]].
  const Eigen::Matrix6d& tensor = body->getSpatialInertia();
  return {tensor(3, 3), {tensor(2, 4), tensor(0, 5), tensor(1, 3)}, tensor.topLeftCorner<3, 3>()};
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
  links.push_back({&body, &joint, columns_reader(joint), parent, first_dof, num_dofs});
  for (std::size_t i = 0; i < body.getNumChildBodyNodes(); ++i)
    add(*body.getChildBodyNode(i), index);
}

} // namespace pydart2
