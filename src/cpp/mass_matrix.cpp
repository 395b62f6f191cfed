#include "mass_matrix.hpp"

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

/// The engine's own memory for M and whether it is out of date. Filling that instead of a second one keeps one truth,
/// and lets the engine's own bookkeeping say when M has to be computed again.
struct EngineCache : dart::dynamics::Skeleton
{
  static auto& of(dart::dynamics::Skeleton& skeleton) { return skeleton.*(&EngineCache::mSkelCache); }
};

using Columns = Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>;
using Momenta = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 6>; // at most 6 columns: no allocation

} // namespace

MassMatrix::MassMatrix(dart::dynamics::Skeleton& skeleton) : skeleton_(skeleton)
{
  for (std::size_t tree = 0; tree < skeleton.getNumTrees(); ++tree)
    add(*skeleton.getRootBodyNode(tree), -1);
  inertias_.resize(links_.size());
}

void MassMatrix::add(dart::dynamics::BodyNode& body, int parent)
{
  const Joint& joint = *body.getParentJoint();
  const auto num_dofs = static_cast<int>(joint.getNumDofs());
  const int first_dof = num_dofs == 0 ? 0 : static_cast<int>(joint.getIndexInSkeleton(0));
  const auto index = static_cast<int>(links_.size());
  links_.push_back({&body, &joint, columns_reader(joint), parent, first_dof, num_dofs});
  for (std::size_t i = 0; i < body.getNumChildBodyNodes(); ++i)
    add(*body.getChildBodyNode(i), index);
}

const Eigen::MatrixXd& MassMatrix::update()
{
  if (skeleton_.getNumSoftBodyNodes() > 0)
    return skeleton_.getMassMatrix();
  auto& cache = EngineCache::of(skeleton_);
  if (cache.mDirty.mMassMatrix) {
    cache.mM.setZero();
    read_own_inertias();
    compose_inertias();
    for (std::size_t i = 0; i < links_.size(); ++i)
      fill(i, cache.mM);
    cache.mDirty.mMassMatrix = false;
  }
  return cache.mM;
}

void MassMatrix::read_own_inertias()
{
  for (std::size_t i = 0; i < links_.size(); ++i) {
    // DART's tensor is [[I, [h]], [[h]^T, m 1]].
    const Eigen::Matrix6d& tensor = links_[i].body->getSpatialInertia();
    inertias_[i] = {tensor(3, 3), {tensor(2, 4), tensor(0, 5), tensor(1, 3)}, tensor.topLeftCorner<3, 3>()};
  }
}

void MassMatrix::compose_inertias()
{
  const auto cross = [](const Eigen::Vector3d& v) {
    return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
  };
  for (std::size_t i = links_.size(); i-- > 0;) {
    if (links_[i].parent < 0)
      continue;
    const Eigen::Isometry3d& T = links_[i].joint->getRelativeTransform();
    const auto R = T.linear();
    const Eigen::Vector3d p = T.translation();
    const Inertia& own = inertias_[i];
    const Eigen::Vector3d Rh = R * own.h;
    const Eigen::Vector3d h = Rh + own.m * p;
    Inertia& parent = inertias_[static_cast<std::size_t>(links_[i].parent)];
    parent.m += own.m;
    parent.h += h;
    parent.I += R * own.I * R.transpose() - cross(p) * cross(Rh) - cross(h) * cross(p);
  }
}

void MassMatrix::fill(std::size_t index, Eigen::MatrixXd& M) const
{
  const Link& link = links_[index];
  if (link.num_dofs == 0)
    return;
  const Inertia& C = inertias_[index];
  const Columns S(link.columns(*link.joint), 6, link.num_dofs);
  Momenta F(6, link.num_dofs);
  for (int k = 0; k < link.num_dofs; ++k) {
    const Eigen::Vector3d w = S.col(k).head<3>(), v = S.col(k).tail<3>();
    F.col(k) << C.I * w + C.h.cross(v), C.m * v - C.h.cross(w);
  }
  const Link* at = &link;
  while (true) {
    if (at->num_dofs > 0) {
      const Columns S_j(at->columns(*at->joint), 6, at->num_dofs);
      for (int k = 0; k < link.num_dofs; ++k)
        for (int l = 0; l < at->num_dofs; ++l) {
          const double entry = F.col(k).dot(S_j.col(l));
          M(link.first_dof + k, at->first_dof + l) = entry;
          M(at->first_dof + l, link.first_dof + k) = entry;
        }
    }
    if (at->parent < 0)
      return;
    const Eigen::Isometry3d& T = at->joint->getRelativeTransform();
    for (int k = 0; k < link.num_dofs; ++k) {
      const Eigen::Vector3d linear = T.linear() * F.col(k).tail<3>();
      F.col(k) << T.linear() * F.col(k).head<3>() + T.translation().cross(linear), linear;
    }
    at = &links_[static_cast<std::size_t>(at->parent)];
  }
}

} // namespace pydart2
