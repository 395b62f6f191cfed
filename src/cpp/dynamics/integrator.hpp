#pragma once

#include <string>

#include "dynamics/armature.hpp"
#include "dynamics/bias_forces.hpp"
#include "dynamics/mass_matrix.hpp"

namespace pydart2 {

/// How the velocities and positions of a skeleton go on. The engine's rule is semi-implicit Euler, with damping and springs
/// implicit and Coriolis forces explicit.
enum class Integrator { engine, implicit, rk4, variational };

/// ValueError for an unknown name.
Integrator integrator_named(const std::string& name);
const char* name_of(Integrator integrator);

/// Steps of a skeleton of rigid bodies other than the engine's, in the coordinates and velocities of its dofs:
///
///   (M(q) + A) dq' = f - c(q, dq) - D dq - K (q - rest),
///
/// with A the armature, f the forces of the actuators and of external forces, which are held for the step.
///
/// Where joints turn, positions near those before the step, q0, are given by r, the velocities of the joints that lead
/// there in unit time: q = q0 (+) r. Valid until the tree changes.
class SkeletonIntegrator
{
public:
  explicit SkeletonIntegrator(dart::dynamics::Skeleton& skeleton);

  /// Makes of the engine's accelerations for a step of length h, (M + A + h D + h^2 K) a = w, those that have the Coriolis
  /// forces implicit too, (M + A + h D + h^2 K + h C) a' = w. They are quadratic in dq: C dq with C = 1/2 dc/ddq. Where
  /// velocities are the rates of positions, dM/dt - 2 C is skew-symmetric, so that C times the velocity at the end leaves
  /// the energy alone where all of dc/ddq would feed it. Dofs whose motion is prescribed keep it.
  void make_implicit(const Armature& armature, double h);

  /// rk4 and variational begin with the state before a step. When the engine's rule has predicted velocities, and contacts
  /// and constraints have had their say, they know whether the skeleton moves freely: no motion is prescribed and nothing
  /// has changed the prediction.
  void begin();
  void keep_prediction();
  bool moves_freely() const;

  /// Whether no joint's motion is prescribed, and no limit or friction of one has acted.
  bool joints_are_free() const;

  /// Lee, Liu, Park, Srinivasa, "A Linear-Time Variational Integrator for Multibody Systems", WAFR 2016, with momenta for
  /// the state and a dense mass matrix for the quasi-Newton steps. False if
  /// these do not converge, the step being too long; then the state is that of the prediction.
  bool step_variational(const Armature& armature, double h);

  /// For HeldMotion: how r and dq change, where r leads, and what acts there.
  struct Rates
  {
    Eigen::VectorXd r, dq;
  };

  Eigen::VectorXd velocities() const { return skeleton_.getVelocities(); }
  Eigen::VectorXd velocities_before() const { return dq0_; }
  Eigen::VectorXd forces_at(const Eigen::VectorXd& r, const Eigen::VectorXd& dq);
  Eigen::VectorXd rate_of(const Eigen::VectorXd& r, const Eigen::VectorXd& dq) const;
  Eigen::MatrixXd mass(const Armature& armature);
  void move(const Eigen::VectorXd& r);
  void count_from_here() { q0_ = skeleton_.getPositions(); }
  void set_velocities(const Eigen::VectorXd& dq, double h);

private:
  /// The poses of all links and what takes wrenches on them to the dofs.
  struct Place
  {
    Eigen::Isometry3d in_world, in_parent;
    Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6> S;
  };
  using Places = std::vector<Place>;

  bool has_prescribed_motion() const;
  Eigen::VectorXd actuator_forces() const;
  void go_back(double h, const Eigen::VectorXd& dq);

  Places places() const;
  Eigen::VectorXd generalised(const Places& places, std::vector<Eigen::Vector6d> wrenches) const;
  Eigen::VectorXd forces(const Places& places) const;
  std::vector<Eigen::Vector6d> displacement_momenta(const Places& from, const Places& to, bool at_end) const;

  dart::dynamics::Skeleton& skeleton_;
  LinkTree tree_;
  MassMatrix mass_matrix_;
  BiasForces bias_forces_;
  Eigen::VectorXd q0_, dq0_, predicted_;
};

} // namespace pydart2
