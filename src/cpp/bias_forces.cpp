#include "bias_forces.hpp"

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Joint.hpp>

namespace pydart2 {

const Eigen::VectorXd& BiasForces::update(const LinkTree& tree)
{
  auto& skeleton = tree.skeleton;
  if (skeleton.getNumSoftBodyNodes() > 0)
    return skeleton.getCoriolisAndGravityForces();
  auto& cache = EngineCache::of(skeleton);
  if (cache.mDirty.mCoriolisAndGravityForces) {
    go_outwards(tree);
    go_inwards(tree.links, cache.mCg);
    cache.mDirty.mCoriolisAndGravityForces = false;
  }
  return cache.mCg;
}

void BiasForces::go_outwards(const LinkTree& tree)
{
  motions_.resize(tree.links.size());
  const Motion base{{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}, {}, tree.skeleton.getGravity()};
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const Link& link = tree.links[i];
    const Motion& parent = link.parent < 0 ? base : motions_[static_cast<std::size_t>(link.parent)];
    const Eigen::Isometry3d& T = link.joint->getRelativeTransform();
    const Eigen::Vector6d& V = link.body->getSpatialVelocity();
    const Eigen::Vector6d& partial = link.body->getPartialAcceleration();
    const auto turned = T.linear().transpose();
    auto& [a, F, g] = motions_[i];

    a.angular = turned * parent.acceleration.angular + partial.head<3>();
    a.linear = turned * (parent.acceleration.linear + parent.acceleration.angular.cross(T.translation())) + partial.tail<3>();
    g = turned * parent.gravity;

    const SpatialInertia I = link.inertia();
    const Spatial v{V.head<3>(), V.tail<3>()}, momentum = I * v;
    F = I * Spatial{a.angular, link.body->getGravityMode() ? Eigen::Vector3d(a.linear - g) : a.linear};
    F.angular += v.angular.cross(momentum.angular) + v.linear.cross(momentum.linear);
    F.linear += v.angular.cross(momentum.linear);
  }
}

void BiasForces::go_inwards(const std::vector<Link>& links, Eigen::VectorXd& c)
{
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    const Spatial& F = motions_[i].force;
    for (int k = 0; k < link.num_dofs; ++k) {
      const auto column = link.S().col(k);
      c[link.first_dof + k] = column.head<3>().dot(F.angular) + column.tail<3>().dot(F.linear);
    }
    if (link.parent < 0)
      continue;
    const Spatial added = link.to_parent(F);
    Spatial& parent = motions_[static_cast<std::size_t>(link.parent)].force;
    parent.angular += added.angular;
    parent.linear += added.linear;
  }
}

} // namespace pydart2
