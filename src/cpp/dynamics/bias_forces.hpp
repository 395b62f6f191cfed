#pragma once

#include <vector>

#include "dynamics/link_tree.hpp"

namespace pydart2 {

/// Coriolis, centrifugal and gravity forces c of a skeleton: the recursive Newton-Euler algorithm (Featherstone, Rigid
/// Body Dynamics Algorithms, 2008, section 5.3) with joint accelerations of zero. The same as DART's own, without its
/// allocations.
///
/// With the links in an order where parents come first, each vector in the frame of its link, X from parent to link:
///
///   1. From the root outwards: v_i = X v_p(i) + S_i q' and a_i = X a_p(i) + v_i x S_i q' + S_i' q', the acceleration
///      without gravity. Gravity g_i = R^T g_p(i).
///   2. F_i = I_i (a_i - g_i) + v_i x* I_i v_i, with g_i only where gravity acts on the body.
///   3. From the leaves inwards: c_i = S_i^T F_i, and F_i taken to the parent's frame is added to F_p(i).
class BiasForces
{
public:
  /// Of the present state. That of a skeleton with soft bodies is computed by DART.
  const Eigen::VectorXd& compute(const LinkTree& tree);

  /// The same as the engine's vector, computed where it is out of date: by one object for each skeleton.
  const Eigen::VectorXd& update(const LinkTree& tree);

private:
  struct Motion
  {
    Spatial velocity, acceleration, force;
    Eigen::Vector3d gravity;
  };

  bool note_velocities(const LinkTree& tree);
  void go_outwards(const LinkTree& tree);
  void go_inwards(const std::vector<Link>& links, Eigen::VectorXd& c);

  std::vector<Motion> motions_;
  struct Velocity
  {
    const double* now;
    double noted;
  };
  std::vector<Velocity> velocities_;
  Eigen::VectorXd forces_;
};

/// The part of c that is gravity's. DART's own sum for skeletons with soft bodies has numbers that nobody ever set.
Eigen::VectorXd gravity_forces(const dart::dynamics::Skeleton& skeleton);

/// Of contacts, limits and constraints in the last step. DART's own sum for skeletons with several roots takes the first
/// for all of them, and grows each time that it is asked for.
Eigen::VectorXd constraint_forces(const dart::dynamics::Skeleton& skeleton);

} // namespace pydart2
