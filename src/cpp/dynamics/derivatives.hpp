#pragma once

#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

/// How the forces of inverse dynamics, M ddq + c, change with q and dq, both (dofs x dofs). A change of q is one along
/// velocities, as which the free and the ball joints have the motions of their body. The recursion is that of
/// Carpentier, Mansard, "Analytical derivatives of rigid body dynamics algorithms", RSS 2018, with all vectors at one
/// point in the world's axes; a joint whose axes turn each other (Euler, universal, planar) is a chain of joints.
struct InverseDynamicsDerivatives
{
  Eigen::MatrixXd by_q, by_dq;
};

/// At the present q and dq. A skeleton of rigid bodies.
InverseDynamicsDerivatives inverse_dynamics_derivatives(const dart::dynamics::Skeleton& skeleton, const Eigen::VectorXd& ddq);

} // namespace pydart2
