#include "dynamics/bias_forces.hpp"

#include <algorithm>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/Joint.hpp>

#include <limits>

#include "engine/protected_members.hpp"

namespace pydart2 {

const Eigen::VectorXd& BiasForces::update(const LinkTree& tree)
{
  auto& skeleton = tree.skeleton;
  if (skeleton.getNumSoftBodyNodes() > 0)
    return skeleton.getCoriolisAndGravityForces();
  auto& cache = EngineCache::of(skeleton);
  const bool moves_otherwise = note_velocities(tree); // a body whose velocity nobody has asked for does not tell of a new one
  if (moves_otherwise || cache.mDirty.mCoriolisAndGravityForces) {
    cache.mCg = compute(tree);
    cache.mDirty.mCoriolisAndGravityForces = false;
  }
  return cache.mCg;
}

const Eigen::VectorXd& BiasForces::compute(const LinkTree& tree)
{
  auto& skeleton = tree.skeleton;
  if (skeleton.getNumSoftBodyNodes() > 0)
    return skeleton.getCoriolisAndGravityForces();
  forces_.resize(static_cast<long>(skeleton.getNumDofs()));
  go_outwards(tree);
  go_inwards(tree.links, forces_);
  return forces_;
}

/// Whether they differ from those noted before.
bool BiasForces::note_velocities(const LinkTree& tree)
{
  if (velocities_.empty())
    for (const Link& link : tree.links)
      for (int k = 0; k < link.num_dofs; ++k)
        velocities_.push_back({link.numbers.velocities + k, std::numeric_limits<double>::quiet_NaN()});
  if (std::all_of(velocities_.begin(), velocities_.end(), [](const auto& velocity) { return velocity.noted == *velocity.now; }))
    return false;
  for (auto& [now, noted] : velocities_)
    noted = *now;
  return true;
}

void BiasForces::go_outwards(const LinkTree& tree)
{
  motions_.resize(tree.links.size());
  const Spatial none{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const Motion base{none, none, {}, tree.skeleton.getGravity()};
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const Link& link = tree.links[i];
    const Motion& parent = link.parent < 0 ? base : motions_[static_cast<std::size_t>(link.parent)];
    auto& [v, a, F, g] = motions_[i];

    v = link.from_parent(parent.velocity);
    a = link.from_parent(parent.acceleration);
    g = link.joint->getRelativeTransform().linear().transpose() * parent.gravity;
    if (link.num_dofs > 0) {
      const Spatial joint_velocity = link.times_velocities(link.S());
      v += joint_velocity;
      a += cross(v, joint_velocity);
      a += link.times_velocities(link.S_rate());
    }

    const SpatialInertia I = link.inertia();
    F = I * Spatial{a.angular, link.body->getGravityMode() ? Eigen::Vector3d(a.linear - g) : a.linear};
    F += cross_force(v, I * v);
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
    if (link.parent >= 0)
      motions_[static_cast<std::size_t>(link.parent)].force += link.to_parent(F);
  }
}

Eigen::VectorXd gravity_forces(const dart::dynamics::Skeleton& skeleton)
{
  if (skeleton.getNumSoftBodyNodes() == 0)
    return skeleton.getGravityForces();
  return skeleton.getCoriolisAndGravityForces() - skeleton.getCoriolisForces();
}

Eigen::VectorXd constraint_forces(const dart::dynamics::Skeleton& skeleton)
{
  Eigen::VectorXd forces(skeleton.getNumDofs());
  for (std::size_t tree = 0; tree < skeleton.getNumTrees(); ++tree) {
    const auto& of_tree = skeleton.getConstraintForces(tree);
    for (const auto* dof : skeleton.getTreeDofs(tree))
      forces[static_cast<long>(dof->getIndexInSkeleton())] = of_tree[static_cast<long>(dof->getIndexInTree())];
  }
  return forces;
}

} // namespace pydart2
