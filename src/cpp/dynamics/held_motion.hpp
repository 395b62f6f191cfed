#pragma once

#include <dart/dynamics/BodyNode.hpp>
#include <vector>

#include "dynamics/integrator.hpp"

namespace pydart2 {

/// A point of a body that stays at a point of another, or of the world (body2 is null); or, for a rod, `length` from it.
struct Tie
{
  const dart::dynamics::BodyNode *body1 = nullptr, *body2 = nullptr;
  Eigen::Vector3d point1, point2; ///< In the bodies; point2 in the world if there is no second one.
  double length = 0.0;            ///< 0 for points that coincide.
};

/// Skeletons that move freely but for ties, as one system:
///
///   M dq' = f - c + J^T lambda   with   J dq' + (dJ/dt) dq = 0
///
/// (Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 8). Rows of J that say the same do no harm.
class HeldMotion
{
public:
  struct Member
  {
    dart::dynamics::Skeleton* skeleton;
    SkeletonIntegrator* integrator;
    const Armature* armature;
  };

  HeldMotion(std::vector<Member> members, std::vector<Tie> ties);

  /// How far the ties are off at most, m.
  double error() const;

  /// The classical Runge-Kutta method of fourth order, in the r of SkeletonIntegrator (Munthe-Kaas, BIT 38, 1998). Then
  /// positions and velocities are taken, by the shortest way in the metric of M, to where the ties hold.
  void step_rk4(double h);

private:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  struct Rows
  {
    Vector errors, bias; ///< bias: (dJ/dt) dq
    Matrix J;
  };

  SkeletonIntegrator::Rates rates(const Vector& r, const Vector& dq);
  void move(const Vector& r);
  void set_velocities(const Vector& dq, double h);
  void close(double h);
  Rows rows() const;
  Matrix jacobian(const dart::dynamics::BodyNode* body, const Eigen::Vector3d& point) const;
  Matrix over_mass(Matrix columns) const;
  Vector gather(Eigen::VectorXd (SkeletonIntegrator::*part)() const) const;

  std::vector<Member> members_;
  std::vector<long> first_; ///< The first dof of each member, and their number.
  std::vector<Tie> ties_;
  std::vector<Eigen::LLT<Matrix>> masses_; ///< Where the members stand.
};

} // namespace pydart2
