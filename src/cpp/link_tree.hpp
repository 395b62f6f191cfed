#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <vector>

namespace pydart2 {

using Columns = Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>;

/// A spatial vector in a link's frame: velocity, acceleration or, with moment and force, what acts on it.
struct Spatial
{
  Eigen::Vector3d angular, linear;
};

/// Mass, first moment h and rotational inertia about the origin of the link's frame.
struct SpatialInertia
{
  double m;
  Eigen::Vector3d h;
  Eigen::Matrix3d I;

  Spatial operator*(const Spatial& v) const
  {
    return {I * v.angular + h.cross(v.linear), m * v.linear - h.cross(v.angular)};
  }
};

/// A body with the joint to its parent, and where its numbers are.
struct Link
{
  const dart::dynamics::BodyNode* body;
  const dart::dynamics::Joint* joint;
  const double* (*columns)(const dart::dynamics::Joint&); ///< Where the engine keeps S, 6 numbers per dof.
  int parent, first_dof, num_dofs;

  /// The joint's Jacobian S: a column [angular; linear] in the link's frame per dof.
  Columns S() const { return {columns(*joint), 6, num_dofs}; }

  SpatialInertia inertia() const;

  /// A force on the link as one on its parent.
  Spatial to_parent(const Spatial& force) const;
};

/// The links of a skeleton of rigid bodies, parents first. Valid until the tree changes.
struct LinkTree
{
  explicit LinkTree(dart::dynamics::Skeleton& skeleton);

  dart::dynamics::Skeleton& skeleton;
  std::vector<Link> links;

private:
  void add(dart::dynamics::BodyNode& body, int parent);
};

/// The engine's own memory for M and c, and whether they are out of date. Filling that instead of a second one keeps one
/// truth, and lets the engine's own bookkeeping say when they have to be computed again.
struct EngineCache : dart::dynamics::Skeleton
{
  static auto& of(dart::dynamics::Skeleton& skeleton) { return skeleton.*(&EngineCache::mSkelCache); }
};

} // namespace pydart2
