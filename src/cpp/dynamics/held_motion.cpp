#include "dynamics/held_motion.hpp"

#include <algorithm>
#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using Eigen::Vector3d;

/// The solution of a symmetric system, the shortest where rows say the same.
Eigen::VectorXd solve_least(const Eigen::MatrixXd& A, const Eigen::VectorXd& b)
{
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(1e-10);
  return decomposition.compute(A).solve(b);
}

Vector3d place(const BodyNode* body, const Vector3d& point)
{
  return body == nullptr ? point : body->getWorldTransform() * point;
}

Vector3d velocity(const BodyNode* body, const Vector3d& point)
{
  return body == nullptr ? Vector3d::Zero() : body->getLinearVelocity(point);
}

Vector3d acceleration(const BodyNode* body, const Vector3d& point)
{
  return body == nullptr ? Vector3d::Zero() : body->getLinearAcceleration(point);
}

} // namespace

HeldMotion::HeldMotion(std::vector<Member> members, std::vector<Tie> ties)
  : members_(std::move(members)), first_{0}, ties_(std::move(ties)), masses_(members_.size())
{
  for (const auto& member : members_)
    first_.push_back(first_.back() + static_cast<long>(member.skeleton->getNumDofs()));
}

double HeldMotion::error() const
{
  double most = 0.0;
  for (const auto& tie : ties_)
    most = std::max(most, std::abs((place(tie.body1, tie.point1) - place(tie.body2, tie.point2)).norm() - tie.length));
  return most;
}

void HeldMotion::move(const Vector& r)
{
  for (std::size_t i = 0; i < members_.size(); ++i)
    members_[i].integrator->move(r.segment(first_[i], first_[i + 1] - first_[i]));
}

void HeldMotion::set_velocities(const Vector& dq, double h)
{
  for (std::size_t i = 0; i < members_.size(); ++i)
    members_[i].integrator->set_velocities(dq.segment(first_[i], first_[i + 1] - first_[i]), h);
}

HeldMotion::Matrix HeldMotion::jacobian(const BodyNode* body, const Vector3d& point) const
{
  Matrix J = Matrix::Zero(3, first_.back());
  for (std::size_t i = 0; i < members_.size() && body != nullptr; ++i)
    if (body->getSkeleton().get() == members_[i].skeleton)
      J.middleCols(first_[i], first_[i + 1] - first_[i]) = members_[i].skeleton->getLinearJacobian(body, point);
  return J;
}

/// What the ties say where the members stand, move and do not accelerate.
HeldMotion::Rows HeldMotion::rows() const
{
  long count = 0;
  for (const auto& tie : ties_)
    count += tie.length > 0.0 ? 1 : 3;
  Rows rows{Vector(count), Vector(count), Matrix(count, first_.back())};
  long at = 0;
  for (const auto& tie : ties_) {
    const Vector3d apart = place(tie.body1, tie.point1) - place(tie.body2, tie.point2);
    const Vector3d v = velocity(tie.body1, tie.point1) - velocity(tie.body2, tie.point2);
    const Vector3d a = acceleration(tie.body1, tie.point1) - acceleration(tie.body2, tie.point2);
    const Matrix J = jacobian(tie.body1, tie.point1) - jacobian(tie.body2, tie.point2);
    if (tie.length > 0.0) {
      const double distance = apart.norm();
      const Vector3d along = apart / distance;
      const double closing = along.dot(v);
      rows.errors[at] = distance - tie.length;
      rows.bias[at] = along.dot(a) + (v.squaredNorm() - closing * closing) / distance;
      rows.J.row(at) = along.transpose() * J;
      at += 1;
    } else {
      rows.errors.segment<3>(at) = apart;
      rows.bias.segment<3>(at) = a;
      rows.J.middleRows<3>(at) = J;
      at += 3;
    }
  }
  return rows;
}

/// M^-1 times them.
HeldMotion::Matrix HeldMotion::over_mass(Matrix columns) const
{
  for (std::size_t i = 0; i < members_.size(); ++i) {
    auto part = columns.middleRows(first_[i], first_[i + 1] - first_[i]);
    part = masses_[i].solve(part.eval());
  }
  return columns;
}

SkeletonIntegrator::Rates HeldMotion::rates(const Vector& r, const Vector& dq)
{
  Vector f(first_.back()), along(first_.back());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const long first = first_[i], size = first_[i + 1] - first;
    const auto& [skeleton, integrator, armature] = members_[i];
    f.segment(first, size) = integrator->forces_at(r.segment(first, size), dq.segment(first, size));
    masses_[i].compute(integrator->mass(*armature));
    along.segment(first, size) = integrator->rate_of(r.segment(first, size), dq.segment(first, size));
    if (!ties_.empty())
      skeleton->setAccelerations(Vector::Zero(size));
  }
  Vector ddq = over_mass(f);
  if (!ties_.empty()) {
    const Rows held = rows();
    const Matrix response = over_mass(held.J.transpose());
    ddq -= response * solve_least(held.J * response, held.J * ddq + held.bias);
  }
  return {along, ddq};
}

void HeldMotion::close(double h)
{
  constexpr int most = 10;
  constexpr double enough = 1e-13; // m
  for (std::size_t i = 0; i < members_.size(); ++i)
    masses_[i].compute(members_[i].integrator->mass(*members_[i].armature));
  for (int i = 0; i < most && error() > enough; ++i) {
    const Rows held = rows();
    const Matrix response = over_mass(held.J.transpose());
    for (const auto& member : members_)
      member.integrator->count_from_here();
    move(-response * solve_least(held.J * response, held.errors));
  }
  const Rows held = rows();
  const Matrix response = over_mass(held.J.transpose());
  const Vector dq = gather(&SkeletonIntegrator::velocities);
  set_velocities(dq - response * solve_least(held.J * response, held.J * dq), h);
}

HeldMotion::Vector HeldMotion::gather(Eigen::VectorXd (SkeletonIntegrator::*part)() const) const
{
  Vector all(first_.back());
  for (std::size_t i = 0; i < members_.size(); ++i)
    all.segment(first_[i], first_[i + 1] - first_[i]) = (members_[i].integrator->*part)();
  return all;
}

void HeldMotion::step_rk4(double h)
{
  const Vector dq0 = gather(&SkeletonIntegrator::velocities_before);
  const auto k1 = rates(Vector::Zero(dq0.size()), dq0);
  const auto k2 = rates(0.5 * h * k1.r, dq0 + 0.5 * h * k1.dq);
  const auto k3 = rates(0.5 * h * k2.r, dq0 + 0.5 * h * k2.dq);
  const auto k4 = rates(h * k3.r, dq0 + h * k3.dq);
  move(h / 6.0 * (k1.r + 2.0 * k2.r + 2.0 * k3.r + k4.r));
  set_velocities(dq0 + h / 6.0 * (k1.dq + 2.0 * k2.dq + 2.0 * k3.dq + k4.dq), h);
  if (!ties_.empty())
    close(h);
}

} // namespace pydart2
