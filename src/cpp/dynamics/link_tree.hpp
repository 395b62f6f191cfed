#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <vector>

namespace pydart2 {

using Columns = Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>;

/// A spatial vector in a link's frame: velocity, acceleration or, with moment and force, what acts on it.
struct Spatial
{
  Eigen::Vector3d angular, linear;

  Spatial& operator+=(const Spatial& other)
  {
    angular += other.angular;
    linear += other.linear;
    return *this;
  }
};

/// v x m of two motions, and v x* f of a motion and a force (Featherstone, section 2.9).
inline Spatial cross(const Spatial& v, const Spatial& m)
{
  return {v.angular.cross(m.angular), v.angular.cross(m.linear) + v.linear.cross(m.angular)};
}
inline Spatial cross_force(const Spatial& v, const Spatial& f)
{
  return {v.angular.cross(f.angular) + v.linear.cross(f.linear), v.angular.cross(f.linear)};
}

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

/// Where the engine keeps the numbers of a joint; none is there for a joint without dofs.
struct JointNumbers
{
  using Find = const double* (*)(const dart::dynamics::Joint&);
  Find S = nullptr, S_rate = nullptr; ///< 6 numbers per dof. The engine brings them up to date when asked.
  const double* velocities = nullptr;
};

/// A body with the joint to its parent.
struct Link
{
  const dart::dynamics::BodyNode* body;
  const dart::dynamics::Joint* joint;
  JointNumbers numbers;
  int parent, first_dof, num_dofs;

  /// The joint's Jacobian S: a column [angular; linear] in the link's frame per dof.
  Columns S() const { return {numbers.S(*joint), 6, num_dofs}; }

  /// Its derivative by the time.
  Columns S_rate() const { return {numbers.S_rate(*joint), 6, num_dofs}; }

  /// S q' or S' q'.
  Spatial times_velocities(const Columns& columns) const;

  SpatialInertia inertia() const;

  /// A motion of the parent as one of the link.
  Spatial from_parent(const Spatial& motion) const;

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

} // namespace pydart2
