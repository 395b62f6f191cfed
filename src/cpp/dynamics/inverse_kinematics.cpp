#include "dynamics/inverse_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/math/Geometry.hpp>

namespace pydart2 {

namespace {

long rows_of(const IkTarget& target)
{
  return (target.position ? 3 : 0) + (target.rotation ? 3 : 0);
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R)
{
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

bool turns_freely(const dart::dynamics::Joint& joint)
{
  return joint.getType() == dart::dynamics::BallJoint::getStaticType()
         || joint.getType() == dart::dynamics::FreeJoint::getStaticType();
}

} // namespace

InverseKinematics::InverseKinematics(
    dart::dynamics::Skeleton& skeleton, std::vector<IkTarget> targets, const std::vector<bool>& moves)
  : skeleton_(skeleton), targets_(std::move(targets)), moves_(Eigen::VectorXd::Zero(static_cast<long>(moves.size())))
{
  for (std::size_t i = 0; i < moves.size(); ++i)
    moves_[static_cast<long>(i)] = moves[i] ? 1 : 0;
  for (auto* joint : skeleton.getJoints())
    if (joint->getNumDofs() > 0)
      groups_.push_back(
          {joint,
           static_cast<long>(joint->getIndexInSkeleton(0)),
           static_cast<long>(joint->getNumDofs()),
           turns_freely(*joint)});
  lower_ = skeleton.getPositionLowerLimits();
  upper_ = skeleton.getPositionUpperLimits();
  long rows = 0;
  for (const auto& target : targets_)
    rows += rows_of(target);
  error_.resize(rows);
  J_.resize(rows, moves_.size());
}

void InverseKinematics::put(const Eigen::VectorXd& q)
{
  q_ = q;
  for (const auto& group : groups_)
    group.joint->setPositions(q_.segment(group.first, group.size));
}

/// The errors at q, and the largest of them without weights.
void InverseKinematics::measure()
{
  residual_ = 0;
  long row = 0;
  for (const auto& target : targets_) {
    if (target.position) {
      const Eigen::Vector3d now
          = target.body ? target.body->getWorldTransform() * target.offset : Eigen::Vector3d(skeleton_.getCOM());
      const Eigen::Vector3d e = *target.position - now;
      residual_ = std::max(residual_, e.norm());
      error_.segment<3>(row) = target.weight * e;
      row += 3;
    }
    if (target.rotation) {
      const Eigen::Vector3d e = rotation_vector(*target.rotation * target.body->getWorldTransform().linear().transpose());
      residual_ = std::max(residual_, e.norm());
      error_.segment<3>(row) = target.weight * e;
      row += 3;
    }
  }
}

void InverseKinematics::linearise()
{
  J_.setZero();
  long row = 0;
  for (const auto& target : targets_) {
    if (!target.body) {
      J_.middleRows<3>(row) = target.weight * skeleton_.getCOMLinearJacobian();
      row += 3;
      continue;
    }
    const auto& J = target.body->getWorldJacobian();
    const Eigen::Vector3d arm = target.body->getWorldTransform().linear() * target.offset;
    for (long k = 0; k < J.cols(); ++k) {
      const auto column = static_cast<long>(target.body->getDependentGenCoordIndex(static_cast<std::size_t>(k)));
      const Eigen::Vector3d angular = J.col(k).head<3>();
      long next = row;
      if (target.position) {
        J_.col(column).segment<3>(next) = target.weight * (J.col(k).tail<3>() + angular.cross(arm));
        next += 3;
      }
      if (target.rotation)
        J_.col(column).segment<3>(next) = target.weight * angular;
    }
    row += rows_of(target);
  }
}

void InverseKinematics::moved_by(const Eigen::VectorXd& dq, Eigen::VectorXd& q) const
{
  for (const auto& group : groups_) {
    const long i = group.first;
    if (group.ball && moves_.segment(i, group.size).sum() > 0) {
      const Eigen::Matrix3d R = dart::math::expMapRot(q.segment<3>(i));
      if (group.size == 6)
        q.segment<3>(i + 3) += R * dq.segment<3>(i + 3);
      q.segment<3>(i) = rotation_vector(R * dart::math::expMapRot(dq.segment<3>(i)));
    }
    else
      for (long k = i; k < i + group.size; ++k)
        if (moves_[k] > 0)
          q[k] = std::min(std::max(q[k] + dq[k], lower_[k]), upper_[k]);
  }
}

/// A dof at a limit may only go away from it.
void InverseKinematics::hold_dofs_at_limits(const Eigen::VectorXd& direction)
{
  free_ = moves_;
  for (const auto& group : groups_)
    if (!group.ball)
      for (long i = group.first; i < group.first + group.size; ++i)
        if ((q_[i] <= lower_[i] && direction[i] < 0) || (q_[i] >= upper_[i] && direction[i] > 0))
          free_[i] = 0;
}

/// Where one step leads; false if nothing may move.
bool InverseKinematics::step(double damping, Eigen::VectorXd& moved)
{
  const Eigen::VectorXd gradient = J_.transpose() * error_;
  hold_dofs_at_limits(gradient);
  if (free_.sum() == 0)
    return false;
  const Eigen::MatrixXd J = J_ * free_.asDiagonal();
  // As many unknowns as there are rows: J^T (J J^T + mu I)^-1 is (J^T J + mu I)^-1 J^T.
  Eigen::MatrixXd A = J * J.transpose();
  A.diagonal().array() += damping;
  const Eigen::VectorXd dq = J.transpose() * A.ldlt().solve(error_);
  moved = q_;
  moved_by(dq, moved);
  return true;
}

/// From q to the nearest positions that no step makes better; true if they are good enough.
bool InverseKinematics::descend(const IkOptions& options, int& iterations)
{
  double lambda = 1;
  int slow = 0;
  Eigen::VectorXd moved;
  measure();
  linearise();
  for (int i = 0; i < options.iterations && residual_ > options.tolerance; ++i) {
    ++iterations;
    const Eigen::VectorXd before = q_;
    const double cost_before = cost();
    if (!step(lambda * cost_before + 1e-14, moved))
      return false;
    put(moved);
    measure();
    if (cost() < cost_before) {
      slow = cost() > 0.8 * cost_before ? slow + 1 : 0;
      lambda = std::max(lambda * 0.3, 1e-6);
      linearise();
    }
    else {
      ++slow;
      lambda *= 8;
      put(before);
      measure();
    }
    if (slow >= 6)
      return false;
  }
  return residual_ <= options.tolerance;
}

/// The step from q to a posture, as far as it leaves the targets where they are.
Eigen::VectorXd InverseKinematics::towards(const Eigen::VectorXd& posture)
{
  const Eigen::VectorXd wish = skeleton_.getPositionDifferences(posture, q_).cwiseProduct(moves_);
  hold_dofs_at_limits(wish);
  const Eigen::VectorXd free_wish = wish.cwiseProduct(free_);
  const Eigen::MatrixXd J = J_ * free_.asDiagonal();
  Eigen::MatrixXd A = J * J.transpose();
  A.diagonal().array() += 1e-12;
  return free_wish - J.transpose() * A.ldlt().solve(J * free_wish);
}

void InverseKinematics::approach(const Eigen::VectorXd& posture, const IkOptions& options, int& iterations)
{
  const auto distance = [&] { return skeleton_.getPositionDifferences(posture, q_).cwiseProduct(moves_).norm(); };
  double length = 1;
  for (int i = 0; i < 40 && length > 1e-3; ++i) {
    const Eigen::VectorXd before = q_;
    const double distance_before = distance();
    const Eigen::VectorXd dq = length * towards(posture);
    if (dq.norm() < 1e-6)
      break;
    Eigen::VectorXd moved = q_;
    moved_by(dq, moved);
    put(moved);
    if (descend(options, iterations) && distance() < distance_before)
      length = std::min(1.0, 2 * length);
    else {
      put(before);
      measure();
      linearise();
      length *= 0.5;
    }
  }
}

/// Within the limits, or in a turn around the first start; near it every other time, where robots with many dofs have
/// their solutions.
Eigen::VectorXd InverseKinematics::random_start(const Eigen::VectorXd& start, int attempt, std::mt19937& random) const
{
  const double reach = attempt % 2 == 0 ? 0.3 : 1;
  Eigen::VectorXd q = start;
  for (const auto& group : groups_)
    for (long i = group.first; i < group.first + group.size; ++i) {
      const double share = static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
      if (group.ball || moves_[i] == 0)
        continue;
      const bool bounded = std::isfinite(lower_[i]) && std::isfinite(upper_[i]);
      const double low = bounded ? lower_[i] : start[i] - M_PI, high = bounded ? upper_[i] : start[i] + M_PI;
      q[i] += reach * (low + share * (high - low) - start[i]);
    }
  return q;
}

IkResult InverseKinematics::solve(
    const Eigen::VectorXd& start, const Eigen::VectorXd* posture, const IkOptions& options)
{
  std::mt19937 random(options.seed);
  Eigen::VectorXd q = start;
  moved_by(Eigen::VectorXd::Zero(q.size()), q); // into the limits
  const Eigen::VectorXd first = q;
  IkResult best{q, std::numeric_limits<double>::infinity(), false, 0, 0};
  for (int attempt = 0; attempt <= options.restarts; ++attempt) {
    if (attempt > 0)
      q = random_start(first, attempt, random);
    put(q);
    best.restarts = attempt;
    best.converged = descend(options, best.iterations);
    if (best.converged && posture != nullptr)
      approach(*posture, options, best.iterations);
    if (best.converged || residual_ < best.residual) {
      best.q = q_;
      best.residual = residual_;
    }
    if (best.converged)
      break;
  }
  return best;
}

} // namespace pydart2
