#pragma once

#include <Eigen/Geometry>
#include <cmath>

/// Functions of dart::math on spatial vectors (angular before linear), inline, with the bits of their results.
namespace pydart2::spatial {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

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
  const Eigen::Vector3d there = twist.tail<3>() + twist.head<3>().cross(T.translation());
  result.tail<3>().noalias() = T.linear().transpose() * there;
  return result;
}

/// The twist of a turn at the speed w in the frame at T, in the frame that T is relative to: dart::math::AdTAngular.
[[gnu::always_inline]] inline Vector6 from_turning(const Eigen::Isometry3d& T, const Eigen::Vector3d& w)
{
  Vector6 result;
  result.head<3>().noalias() = T.linear() * w;
  result.tail<3>() = T.translation().cross(result.head<3>());
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

/// A turn by the rotation vector r (Rodrigues): dart::math::expAngular.
[[gnu::always_inline]] inline Eigen::Isometry3d turn(const Eigen::Vector3d& r)
{
  const double xx = r[0] * r[0], yy = r[1] * r[1], zz = r[2] * r[2];
  const double xy = r[0] * r[1], yz = r[1] * r[2], zx = r[2] * r[0];
  const double angle = std::sqrt(xx + yy + zz);
  const double cosine = std::cos(angle);
  const bool small = !(angle > 1e-6);
  const double a = small ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  const double b = small ? 0.5 - angle * angle / 24.0 : (1.0 - cosine) / angle / angle;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.matrix().col(0) = Eigen::Vector4d(b * xx + cosine, b * xy + a * r[2], b * zx - a * r[1], 0.0);
  result.matrix().col(1) = Eigen::Vector4d(b * xy - a * r[2], b * yy + cosine, b * yz + a * r[0], 0.0);
  result.matrix().col(2) = Eigen::Vector4d(b * zx + a * r[1], b * yz - a * r[0], b * zz + cosine, 0.0);
  return result;
}

/// The rotation by the vector r: dart::math::expMapRot.
[[gnu::always_inline]] inline Eigen::Matrix3d rotation(const Eigen::Vector3d& r)
{
  using Matrix = Eigen::Matrix3d;
  const double angle = r.norm();
  Matrix S;
  S << 0.0, -r[2], r[1], r[2], 0.0, -r[0], -r[1], r[0], 0.0;
  const Matrix S2 = S * S;
  if (angle < 1e-3)
    return Matrix::Identity() + S + 0.5 * S2;
  return Matrix::Identity() + (std::sin(angle) / angle) * S + ((1.0 - std::cos(angle)) / (angle * angle)) * S2;
}

/// The place by the rotation vector and the translation q, of a free joint: dart::dynamics::FreeJoint::convertToTransform.
[[gnu::always_inline]] inline Eigen::Isometry3d placement(const Vector6& q)
{
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = rotation(q.head<3>());
  result.translation() = q.tail<3>();
  return result;
}

/// The vector of a rotation: dart::math::logMap.
[[gnu::always_inline]] inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R)
{
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// R X R' for the rotation R of T, as a block of `result`. Columns of four numbers, the last of which counts for nothing,
/// fit the processor's registers.
[[gnu::always_inline]] inline void put_turned(
    const Eigen::Isometry3d& T, const Eigen::Matrix3d& X, Matrix6& result, int row, int column)
{
  const auto& R = T.matrix();
  const Eigen::Array4d R0 = R.col(0), R1 = R.col(1), R2 = R.col(2);
  const Eigen::Array4d RX0 = R0 * X(0, 0) + R1 * X(1, 0) + R2 * X(2, 0);
  const Eigen::Array4d RX1 = R0 * X(0, 1) + R1 * X(1, 1) + R2 * X(2, 1);
  const Eigen::Array4d RX2 = R0 * X(0, 2) + R1 * X(1, 2) + R2 * X(2, 2);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Array4d entries = RX0 * R(k, 0) + RX1 * R(k, 1) + RX2 * R(k, 2);
    result.block<3, 1>(row, column + k) = entries.head<3>();
  }
}

/// An inertia of which the upper triangle counts, from the frame at T to the frame that T is relative to:
/// dart::math::transformInertia with the inverse of T. With I = [[A, B], [B', C]] and T back = (R', p) it is
///   [[R (A + p x B' - (B + p x C) p x) R', R (B + p x C) R'], [.., R C R']].
[[gnu::always_inline]] inline Matrix6 inertia_to_parent(const Eigen::Isometry3d& T, const Matrix6& I)
{
  using Matrix = Eigen::Matrix3d;
  Eigen::Matrix4d back;
  back.topLeftCorner<3, 3>() = T.linear().transpose();
  const Eigen::Vector3d p = -back.topLeftCorner<3, 3>() * T.translation(); // as in Eigen's inverse of T
  Matrix C, D, E;
  C.triangularView<Eigen::Upper>() = I.block<3, 3>(3, 3);
  C.triangularView<Eigen::StrictlyLower>() = C.transpose();
  for (int k = 0; k < 3; ++k) {
    D(0, k) = I(0, 3 + k) + p[2] * C(1, k) - p[1] * C(2, k);
    D(1, k) = I(1, 3 + k) - p[2] * C(0, k) + p[0] * C(2, k);
    D(2, k) = I(2, 3 + k) + p[1] * C(0, k) - p[0] * C(1, k);
  }
  E(0, 0) = I(0, 0) + p[2] * I(0, 4) - p[1] * I(0, 5) + D(0, 1) * p[2] - D(0, 2) * p[1];
  E(1, 0) = I(0, 1) + p[2] * I(1, 4) - p[1] * I(1, 5) - D(0, 0) * p[2] + D(0, 2) * p[0];
  E(1, 1) = I(1, 1) - p[2] * I(1, 3) + p[0] * I(1, 5) - D(1, 0) * p[2] + D(1, 2) * p[0];
  E(2, 0) = I(0, 2) + p[2] * I(2, 4) - p[1] * I(2, 5) + D(0, 0) * p[1] - D(0, 1) * p[0];
  E(2, 1) = I(1, 2) - p[2] * I(2, 3) + p[0] * I(2, 5) + D(1, 0) * p[1] - D(1, 1) * p[0];
  E(2, 2) = I(2, 2) + p[1] * I(2, 3) - p[0] * I(2, 4) + D(2, 0) * p[1] - D(2, 1) * p[0];
  E.triangularView<Eigen::StrictlyUpper>() = E.transpose();

  Matrix6 result;
  put_turned(T, E, result, 0, 0);
  put_turned(T, D, result, 0, 3);
  put_turned(T, C, result, 3, 3);
  result.triangularView<Eigen::StrictlyLower>() = result.transpose();
  return result;
}

} // namespace pydart2::spatial
