#pragma once

#include <Eigen/Geometry>

/// Functions of dart::math on spatial vectors (angular before linear), inline, with the bits of their results.
namespace pydart2::spatial {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A wrench, from the frame at T to the frame that T is relative to: dart::math::dAdInvT.
[[gnu::always_inline]] inline Vector6 to_parent(const Eigen::Isometry3d& T, const Vector6& wrench)
{
  Vector6 result;
  result.tail<3>().noalias() = T.linear() * wrench.tail<3>();
  result.head<3>().noalias() = T.linear() * wrench.head<3>();
  result.head<3>() += T.translation().cross(result.tail<3>());
  return result;
}

/// A twist, from the frame that T is relative to into the frame at T: dart::math::AdInvT.
[[gnu::always_inline]] inline Vector6 to_child(const Eigen::Isometry3d& T, const Vector6& twist)
{
  Vector6 result;
  result.head<3>().noalias() = T.linear().transpose() * twist.head<3>();
  result.tail<3>().noalias() = T.linear().transpose() * (twist.tail<3>() + twist.head<3>().cross(T.translation()));
  return result;
}

/// The cross product of two motions: dart::math::ad.
[[gnu::always_inline]] inline Vector6 cross(const Vector6& v, const Vector6& m)
{
  Vector6 result;
  result.head<3>() = v.head<3>().cross(m.head<3>());
  result.tail<3>() = v.head<3>().cross(m.tail<3>()) + v.tail<3>().cross(m.head<3>());
  return result;
}

/// Minus the cross product of a motion and a force: dart::math::dad.
[[gnu::always_inline]] inline Vector6 minus_cross_force(const Vector6& v, const Vector6& f)
{
  Vector6 result;
  result.head<3>() = f.head<3>().cross(v.head<3>()) + f.tail<3>().cross(v.tail<3>());
  result.tail<3>() = f.tail<3>().cross(v.head<3>());
  return result;
}

} // namespace pydart2::spatial
