#include "dynamics/weightless.hpp"

#include <dart/dynamics/SoftBodyNode.hpp>
#include <dart/math/Geometry.hpp>
#include <vector>

namespace pydart2 {

namespace {

constexpr double least = 1e-14; // of the largest entry, what rounding leaves of nothing

/// Whether a body and all that hangs from it, as one rigid body of this inertia, resist each dof of its joint.
bool resists(const dart::dynamics::BodyNode& body, const Eigen::Matrix6d& inertia)
{
  const Eigen::MatrixXd axes = body.getParentJoint()->getRelativeJacobian();
  const double largest = inertia.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < axes.cols(); ++i)
    if (!(axes.col(i).dot(inertia * axes.col(i)) > least * largest * axes.col(i).squaredNorm()))
      return false;
  return true;
}

} // namespace

const dart::dynamics::BodyNode* weightless_body(const dart::dynamics::Skeleton& skeleton)
{
  // Of each body with all that hangs from it, in the body's frame; the diagonal of M is made of them.
  std::vector<Eigen::Matrix6d> inertias(skeleton.getNumBodyNodes(), Eigen::Matrix6d::Zero());
  const dart::dynamics::BodyNode* found = nullptr;
  for (std::size_t i = skeleton.getNumBodyNodes(); i-- > 0;) { // children come after their parents
    const auto* body = skeleton.getBodyNode(i);
    inertias[i] += body->getSpatialInertia();
    if (dynamic_cast<const dart::dynamics::SoftBodyNode*>(body) != nullptr) // its points weigh
      inertias[i].diagonal().array() += body->getMass();
    if (!resists(*body, inertias[i]))
      found = body;
    if (const auto* parent = body->getParentBodyNode())
      inertias[parent->getIndexInSkeleton()]
          += dart::math::transformInertia(body->getRelativeTransform().inverse(), inertias[i]);
  }
  return found;
}

} // namespace pydart2
