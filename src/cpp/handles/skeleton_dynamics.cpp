// Mass matrix, forces, centre of mass and energy of a skeleton.

#include <algorithm>

#include "base/errors.hpp"
#include "handles/motion.hpp"
#include "handles/skeleton.hpp"

namespace pydart2 {

using dart::dynamics::DegreeOfFreedom;

namespace {

void copy(const Eigen::VectorXd& values, Output& out)
{
  vector(out, values.size()) = values;
}

} // namespace

void SkeletonHandle::mass_matrix(Output& into) const
{
  skeleton_.get();
  auto& [tree, mass_matrix, bias_forces] = skeleton_.skeleton->passes();
  const Eigen::MatrixXd& M = mass_matrix.update(tree);
  // M is symmetric, so its columns are its rows.
  double* to = into.matrix(M.rows(), M.cols());
  std::copy(M.data(), M.data() + M.size(), to);
  for (const auto& [dof, inertia] : skeleton_.skeleton->armature)
    to[static_cast<long>(dof->getIndexInSkeleton()) * (M.cols() + 1)] += inertia;
}

void SkeletonHandle::inv_mass_matrix(Output& into) const
{
  const auto& armature = skeleton_.skeleton->armature;
  if (armature.empty()) {
    const Eigen::MatrixXd& inverse = skeleton().getInvMassMatrix();
    matrix(into, inverse.rows(), inverse.cols()) = inverse;
    return;
  }
  Eigen::MatrixXd M = skeleton().getMassMatrix();
  for (const auto& [dof, inertia] : armature)
    M.diagonal()[static_cast<long>(dof->getIndexInSkeleton())] += inertia;
  matrix(into, M.rows(), M.cols()) = M.llt().solve(Eigen::MatrixXd::Identity(M.rows(), M.cols()));
}

void SkeletonHandle::coriolis_and_gravity_forces(Output& into) const
{
  skeleton_.get();
  auto& [tree, mass_matrix, bias_forces] = skeleton_.skeleton->passes();
  copy(bias_forces.update(tree), into);
}

void SkeletonHandle::coriolis_forces(Output& out) const
{
  copy(skeleton().getCoriolisForces(), out);
}

void SkeletonHandle::gravity_forces(Output& out) const
{
  copy(pydart2::gravity_forces(skeleton()), out);
}

void SkeletonHandle::external_forces(Output& out) const
{
  copy(skeleton().getExternalForces(), out);
}

void SkeletonHandle::constraint_forces(Output& into) const
{
  copy(pydart2::constraint_forces(skeleton()), into);
}

dart::dynamics::Skeleton& SkeletonHandle::with_mass() const
{
  auto& skeleton = this->skeleton();
  if (skeleton.getMass() == 0) // the engine asserts
    throw Error(Kind::value, "skeleton '" + skeleton.getName() + "' has no mass, so it has no centre of mass");
  return skeleton;
}

const dart::dynamics::Skeleton& SkeletonHandle::moving() const
{
  const auto& skel = with_mass();
  for (const auto* body : skel.getBodyNodes()) {
    find_pose(*skeleton_.world, *skeleton_.skeleton, *body);
    find_velocity(*skeleton_.world, *skeleton_.skeleton, *body);
  }
  return skel;
}

void SkeletonHandle::com(Output& into) const
{
  const auto& skel = with_mass();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(); // as Skeleton::getCOM(), which copies the transform of each body twice
  for (const auto* body : skel.getBodyNodes()) {
    find_pose(*skeleton_.world, *skeleton_.skeleton, *body);
    sum += body->getMass() * (body->getWorldTransform() * body->getLocalCOM());
  }
  vector(into, 3) = sum / skel.getMass();
}

Eigen::Vector3d SkeletonHandle::com_velocity() const
{
  return moving().getCOMLinearVelocity();
}

Eigen::Vector3d SkeletonHandle::com_acceleration() const
{
  return with_mass().getCOMLinearAcceleration();
}

Vector6d SkeletonHandle::com_spatial_velocity() const
{
  return moving().getCOMSpatialVelocity();
}

double SkeletonHandle::kinetic_energy() const
{
  double energy = skeleton().computeKineticEnergy();
  for (const auto& [dof, inertia] : skeleton_.skeleton->armature)
    energy += inertia * dof->getVelocity() * dof->getVelocity() / 2.0;
  return energy;
}

double SkeletonHandle::potential_energy() const
{
  // The engine takes a body's weight at its origin, not at its centre of mass.
  const auto& skel = skeleton();
  double energy = 0.0;
  for (const auto* body : skel.getBodyNodes()) {
    if (body->asSoftBodyNode() != nullptr)
      energy += body->computePotentialEnergy(skel.getGravity());
    else if (body->getGravityMode())
      energy -= body->getMass() * skel.getGravity().dot(body->getCOM());
    energy += body->getParentJoint()->computePotentialEnergy();
  }
  return energy;
}

} // namespace pydart2
