#pragma once

#include "base/arrays.hpp"
#include "handles/bodynode.hpp"
#include "handles/part.hpp"

namespace pydart2 {

/// The terms of a dart::dynamics::Skeleton's equation of motion, and what belongs to its centre of mass. Jacobian rows
/// are angular, then linear; world axes unless said.
class DynamicsHandle
{
public:
  DynamicsHandle(WorldRef world, SkeletonRef skeleton);

  void aug_mass_matrix(Output& out) const;
  void damping_forces(Output& out) const;
  void spring_forces(Output& out) const;

  void com_jacobian(Output& out) const;
  void com_linear_jacobian(Output& out) const;
  void com_linear_jacobian_deriv(Output& out) const;

  /// Angular momentum about the centre of mass and linear momentum, per unit of velocity of each dof.
  void centroidal_momentum_matrix(Output& out) const;

  /// Of M ddq + c by q, and below by dq: (2 dofs x dofs).
  void inverse_dynamics_derivatives(const VectorIn& ddq, Output& out) const;

  /// What a joint transmitted to its child body in the last step, in the joint's frame on that side: moment, force.
  Vector6d joint_wrench(long index) const;

private:
  dart::dynamics::Skeleton& skeleton() const { return *skeleton_; }
  dart::dynamics::Skeleton& with_mass() const;

  Part<dart::dynamics::Skeleton, dart::dynamics::Skeleton*> skeleton_; // SkeletonRecord owns it
};

} // namespace pydart2
