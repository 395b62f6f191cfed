#include "dynamics/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>

#include "base/errors.hpp"
#include "dynamics/derivatives.hpp"
#include "dynamics/each_dof.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::Joint;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Dof = dart::dynamics::DegreeOfFreedom;

constexpr const char* names[] = {"engine", "implicit", "rk4", "variational"};

/// How a rotation vector r changes, exp(r) being a rotation that turns at w, as seen from itself: dexp^-1 of -r.
Vector3d rotation_rate(const Vector3d& r, const Vector3d& w)
{
  const double angle = r.norm();
  const double share = angle < 1e-3 ? 1.0 / 12.0 : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / (angle * angle);
  return w + 0.5 * r.cross(w) + share * r.cross(r.cross(w));
}

// The engine's own exponential map leaves out the third order of small angles, which would be an error of second order.

Eigen::Quaterniond turned_by(const Vector3d& r)
{
  const double angle = r.norm();
  return angle == 0.0 ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(Eigen::AngleAxisd(angle, r / angle));
}

/// Of at most pi.
Vector3d rotation_vector(const Eigen::Quaterniond& rotation)
{
  const double sine = rotation.vec().norm(), cosine = std::abs(rotation.w());
  const double side = rotation.w() < 0.0 ? -1.0 : 1.0;
  return sine == 0.0 ? Vector3d::Zero().eval() : Vector3d(side * 2.0 * std::atan2(sine, cosine) / sine * rotation.vec());
}

/// Of the links with a ball or free joint, calls `visit` with the first dof and whether the joint is a free one.
template <class Visit>
void each_rotation(const LinkTree& tree, Visit visit)
{
  for (const auto& link : tree.links) {
    const auto& type = link.joint->getType();
    const bool free = type == dart::dynamics::FreeJoint::getStaticType();
    if (free || type == dart::dynamics::BallJoint::getStaticType())
      visit(link.first_dof, free);
  }
}

} // namespace

Integrator integrator_named(const std::string& name)
{
  for (int i = 0; i < 4; ++i)
    if (name == names[i])
      return static_cast<Integrator>(i);
  throw Error(Kind::value, "no integrator '" + name + "'; there are engine, implicit, rk4 and variational");
}

const char* name_of(Integrator integrator)
{
  return names[static_cast<int>(integrator)];
}

SkeletonIntegrator::SkeletonIntegrator(dart::dynamics::Skeleton& skeleton) : skeleton_(skeleton), tree_(skeleton) {}

Eigen::MatrixXd SkeletonIntegrator::mass(const Armature& armature)
{
  Eigen::MatrixXd M = mass_matrix_.update(tree_);
  for (const auto& [dof, inertia] : armature) {
    const auto i = static_cast<long>(dof->getIndexInSkeleton());
    M(i, i) += inertia;
  }
  return M;
}

void SkeletonIntegrator::make_implicit(const Armature& armature, double h)
{
  const VectorXd a = skeleton_.getAccelerations();
  Eigen::MatrixXd A = mass(armature);
  A.diagonal() += each_dof(skeleton_, [h](const Dof& dof) {
    return h * (dof.getDampingCoefficient() + h * dof.getSpringStiffness());
  });
  VectorXd w = A * a;
  A += 0.5 * h * inverse_dynamics_derivatives(skeleton_, VectorXd::Zero(a.size())).by_dq;
  for (long i = 0; i < a.size(); ++i)
    if (skeleton_.getDof(static_cast<std::size_t>(i))->getJoint()->isKinematic()) {
      A.row(i).setZero();
      A(i, i) = 1.0;
      w[i] = a[i];
    }
  skeleton_.setAccelerations(A.partialPivLu().solve(w));
}

void SkeletonIntegrator::begin()
{
  q0_ = skeleton_.getPositions();
  dq0_ = skeleton_.getVelocities();
}

void SkeletonIntegrator::keep_prediction()
{
  predicted_ = skeleton_.getVelocities();
}

bool SkeletonIntegrator::moves_freely() const
{
  return !has_prescribed_motion() && skeleton_.getVelocities() == predicted_;
}

bool SkeletonIntegrator::joints_are_free() const
{
  return !has_prescribed_motion()
         && (each_dof(skeleton_, [](const Dof& dof) { return dof.getConstraintImpulse(); }).array() == 0.0).all();
}

bool SkeletonIntegrator::has_prescribed_motion() const
{
  return std::any_of(tree_.links.begin(), tree_.links.end(), [](const auto& link) {
    return link.num_dofs > 0 && link.joint->isKinematic();
  });
}

VectorXd SkeletonIntegrator::actuator_forces() const
{
  return each_dof(skeleton_, [](const Dof& dof) {
    return dof.getJoint()->getActuatorType() == Joint::FORCE ? dof.getCommand() : 0.0;
  });
}

/// To q0 (+) r.
void SkeletonIntegrator::move(const VectorXd& r)
{
  VectorXd q = q0_ + r;
  each_rotation(tree_, [&](long first, bool free) {
    const Eigen::Quaterniond before = turned_by(q0_.segment<3>(first));
    q.segment<3>(first) = rotation_vector(before * turned_by(r.segment<3>(first)));
    if (free)
      q.segment<3>(first + 3) = q0_.segment<3>(first + 3) + before * r.segment<3>(first + 3);
  });
  skeleton_.setPositions(q);
}

/// The accelerations become those that lead there in a step, as after the engine's rule.
void SkeletonIntegrator::set_velocities(const VectorXd& dq, double h)
{
  skeleton_.setVelocities(dq);
  skeleton_.setAccelerations((dq - dq0_) / h);
}

/// To the positions before the step.
void SkeletonIntegrator::go_back(double h, const VectorXd& dq)
{
  skeleton_.setPositions(q0_);
  set_velocities(dq, h);
}

/// Of the dofs, without what M dq' is, where r leads.
VectorXd SkeletonIntegrator::forces_at(const VectorXd& r, const VectorXd& dq)
{
  move(r);
  skeleton_.setVelocities(dq);
  VectorXd f = actuator_forces() + skeleton_.getExternalForces() - bias_forces_.compute(tree_);
  f += each_dof(skeleton_, [](const Dof& dof) {
    return -dof.getDampingCoefficient() * dof.getVelocity()
           - dof.getSpringStiffness() * (dof.getPosition() - dof.getRestPosition());
  });
  return f;
}

VectorXd SkeletonIntegrator::rate_of(const VectorXd& r, const VectorXd& dq) const
{
  VectorXd rate = dq;
  each_rotation(tree_, [&](long first, bool free) {
    const Vector3d turn = r.segment<3>(first);
    rate.segment<3>(first) = rotation_rate(turn, dq.segment<3>(first));
    if (free)
      rate.segment<3>(first + 3) = turned_by(turn) * dq.segment<3>(first + 3);
  });
  return rate;
}

} // namespace pydart2
