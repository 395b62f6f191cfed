#include "handles/dynamics.hpp"

#include <dart/math/Geometry.hpp>

#include "base/checks.hpp"
#include "dynamics/derivatives.hpp"

namespace pydart2 {

DynamicsHandle::DynamicsHandle(WorldRef world, SkeletonRef skeleton)
  : skeleton_(std::move(world), skeleton, skeleton->skeleton.get())
{
}

dart::dynamics::Skeleton& DynamicsHandle::with_mass() const
{
  auto& skel = skeleton();
  if (skel.getMass() == 0) // the engine asserts
    throw Error(Kind::value, "skeleton '" + skel.getName() + "' has no mass, so it has no centre of mass");
  return skel;
}

void DynamicsHandle::aug_mass_matrix(Output& out) const
{
  auto& skel = skeleton();
  const auto dofs = skel.getDofs();
  const double dt = skel.getTimeStep();
  Eigen::MatrixXd sum = skel.getMassMatrix(); // the engine does not notice when what it adds changes
  for (std::size_t i = 0; i < dofs.size(); ++i)
    sum(static_cast<long>(i), static_cast<long>(i))
        += dt * (dofs[i]->getDampingCoefficient() + dt * dofs[i]->getSpringStiffness());
  matrix(out, sum.rows(), sum.cols()) = sum;
}

void DynamicsHandle::damping_forces(Output& out) const
{
  const auto dofs = skeleton().getDofs();
  double* force = out.vector(static_cast<long>(dofs.size()));
  for (const auto* dof : dofs)
    *force++ = -dof->getDampingCoefficient() * dof->getVelocity();
}

void DynamicsHandle::spring_forces(Output& out) const
{
  const auto dofs = skeleton().getDofs();
  double* force = out.vector(static_cast<long>(dofs.size()));
  for (const auto* dof : dofs)
    *force++ = dof->getSpringStiffness() * (dof->getRestPosition() - dof->getPosition());
}

void DynamicsHandle::com_jacobian(Output& out) const
{
  const auto J = with_mass().getCOMJacobian();
  matrix(out, J.rows(), J.cols()) = J;
}

void DynamicsHandle::com_linear_jacobian(Output& out) const
{
  const auto J = with_mass().getCOMLinearJacobian();
  matrix(out, J.rows(), J.cols()) = J;
}

void DynamicsHandle::com_linear_jacobian_deriv(Output& out) const
{
  const auto J = with_mass().getCOMLinearJacobianDeriv();
  matrix(out, J.rows(), J.cols()) = J;
}

void DynamicsHandle::centroidal_momentum_matrix(Output& out) const
{
  const auto& skel = with_mass();
  if (skel.getNumSoftBodyNodes() > 0)
    throw Error(
        Kind::value, "skeleton '" + skel.getName() + "' has soft bodies; the momentum of their points is not in its dofs");
  auto A = matrix(out, 6, static_cast<long>(skel.getNumDofs()));
  A.setZero();
  Eigen::Isometry3d com = Eigen::Isometry3d::Identity();
  com.translation() = skel.getCOM();
  for (const auto* body : skel.getBodyNodes()) {
    const auto to_body = body->getWorldTransform().inverse() * com;
    const auto momenta = (body->getInertia().getSpatialTensor() * body->getJacobian()).eval();
    for (long k = 0; k < momenta.cols(); ++k)
      A.col(static_cast<long>(body->getDependentGenCoordIndex(static_cast<std::size_t>(k))))
          += dart::math::dAdT(to_body, momenta.col(k));
  }
}

void DynamicsHandle::inverse_dynamics_derivatives(const VectorIn& ddq, Output& out) const
{
  const auto& skel = skeleton();
  const auto n = static_cast<long>(skel.getNumDofs());
  check::size(ddq.size, skel.getNumDofs(), "accelerations");
  check::finite(ddq, "accelerations");
  if (skel.getNumSoftBodyNodes() > 0)
    throw Error(Kind::value, "skeleton '" + skel.getName() + "' has soft bodies, for which there are no derivatives");
  const auto derivatives = pydart2::inverse_dynamics_derivatives(skel, ddq.eigen());
  auto both = matrix(out, 2 * n, n);
  both.topRows(n) = derivatives.by_q;
  both.bottomRows(n) = derivatives.by_dq;
}

Vector6d DynamicsHandle::joint_wrench(long index) const
{
  auto& skel = skeleton();
  const auto& joint = *skel.getJoint(check::index(index, skel.getNumJoints(), "joint"));
  return dart::math::dAdT(joint.getTransformFromChildBodyNode(), joint.getChildBodyNode()->getBodyForce());
}

} // namespace pydart2
