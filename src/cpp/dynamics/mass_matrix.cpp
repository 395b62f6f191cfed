#include "dynamics/mass_matrix.hpp"

#include <array>
#include <dart/dynamics/Joint.hpp>

#include "engine/protected_members.hpp"

namespace pydart2 {

const Eigen::MatrixXd& MassMatrix::update(const LinkTree& tree)
{
  auto& skeleton = tree.skeleton;
  if (skeleton.getNumSoftBodyNodes() > 0)
    return skeleton.getMassMatrix();
  auto& cache = EngineCache::of(skeleton);
  if (cache.mDirty.mMassMatrix) {
    cache.mM.setZero();
    compose_inertias(tree.links);
    for (std::size_t i = 0; i < tree.links.size(); ++i)
      fill(tree.links, i, cache.mM);
    cache.mDirty.mMassMatrix = false;
  }
  return cache.mM;
}

void MassMatrix::compose_inertias(const std::vector<Link>& links)
{
  const auto cross = [](const Eigen::Vector3d& v) {
    return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
  };
  inertias_.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i)
    inertias_[i] = links[i].inertia();
  for (std::size_t i = links.size(); i-- > 0;) {
    if (links[i].parent < 0)
      continue;
    const Eigen::Isometry3d& T = links[i].joint->getRelativeTransform();
    const auto R = T.linear();
    const Eigen::Vector3d p = T.translation();
    const SpatialInertia& own = inertias_[i];
    const Eigen::Vector3d Rh = R * own.h;
    const Eigen::Vector3d h = Rh + own.m * p;
    SpatialInertia& parent = inertias_[static_cast<std::size_t>(links[i].parent)];
    parent.m += own.m;
    parent.h += h;
    parent.I += R * own.I * R.transpose() - cross(p) * cross(Rh) - cross(h) * cross(p);
  }
}

void MassMatrix::fill(const std::vector<Link>& links, std::size_t index, Eigen::MatrixXd& M) const
{
  const Link& link = links[index];
  if (link.num_dofs == 0)
    return;
  const Columns S = link.S();
  std::array<Spatial, 6> columns;
  Spatial* F = columns.data();
  for (int k = 0; k < link.num_dofs; ++k)
    F[k] = inertias_[index] * Spatial{S.col(k).head<3>(), S.col(k).tail<3>()};
  for (const Link* at = &link;; at = &links[static_cast<std::size_t>(at->parent)]) {
    if (at->num_dofs > 0) {
      const Columns S_j = at->S();
      for (int k = 0; k < link.num_dofs; ++k)
        for (int l = 0; l < at->num_dofs; ++l) {
          const double entry = F[k].angular.dot(S_j.col(l).head<3>()) + F[k].linear.dot(S_j.col(l).tail<3>());
          M(link.first_dof + k, at->first_dof + l) = entry;
          M(at->first_dof + l, link.first_dof + k) = entry;
        }
    }
    if (at->parent < 0)
      return;
    for (int k = 0; k < link.num_dofs; ++k)
      F[k] = at->to_parent(F[k]);
  }
}

} // namespace pydart2
