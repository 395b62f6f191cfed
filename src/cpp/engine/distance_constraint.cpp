#include "engine/distance_constraint.hpp"

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <limits>

namespace pydart2::engine {

using dart::constraint::ConstraintInfo;
using dart::dynamics::BodyNode;
using dart::dynamics::SkeletonPtr;

DistanceConstraint::DistanceConstraint(
    BodyNode* body1, BodyNode* body2, const Eigen::Vector3d& point1, const Eigen::Vector3d& point2, double length,
    bool rope)
  : DynamicJointConstraint(body1),
    point1_(body1->getWorldTransform().inverse() * point1),
    point2_(body2 == nullptr ? point2 : body2->getWorldTransform().inverse() * point2),
    length_(length),
    rope_(rope)
{
  mBodyNode2 = body2; // the constructor with two bodies takes no null
  mDim = 1;
  directions_.fill(Eigen::Vector6d::Zero());
}

const std::string& DistanceConstraint::getType() const
{
  static const std::string type = "DistanceConstraint";
  return type;
}

BodyRows DistanceConstraint::rows() const
{
  return {{SumOrder::lanes}, bodies(), {directions_[0], directions_[1]}};
}

void DistanceConstraint::update()
{
  const auto world = [](const BodyNode* body, const Eigen::Vector3d& point) -> Eigen::Vector3d {
    return body == nullptr ? point : body->getWorldTransform() * point;
  };
  const Eigen::Vector3d between = world(mBodyNode1, point1_) - world(mBodyNode2, point2_);
  const double distance = between.norm();
  error_ = distance - length_;
  // Points that coincide have no direction between them, and any one parts them.
  const Eigen::Vector3d along = distance > 0.0 ? Eigen::Vector3d(between / distance) : Eigen::Vector3d::UnitZ();
  const auto direction = [&](const BodyNode* body, const Eigen::Vector3d& point, double sign) {
    Eigen::Vector6d wrench = Eigen::Vector6d::Zero();
    if (body != nullptr) {
      wrench.tail<3>() = sign * body->getWorldTransform().linear().transpose() * along;
      wrench.head<3>() = point.cross(wrench.tail<3>());
    }
    return wrench;
  };
  directions_ = {direction(mBodyNode1, point1_, 1.0), direction(mBodyNode2, point2_, -1.0)};
}

void DistanceConstraint::getInformation(ConstraintInfo* info)
{
  double rate = 0.0;
  for (std::size_t side = 0; side < 2; ++side)
    if (bodies()[side] != nullptr)
      rate += directions_[side].dot(bodies()[side]->getSpatialVelocity());
  const bool slack = rope_ && error_ < 0.0; // it may become taut within the step
  const double correction = slack ? error_ : error_ * mErrorReductionParameter;
  info->b[0] = -rate - correction * info->invTimeStep;
  info->lo[0] = -std::numeric_limits<double>::infinity();
  info->hi[0] = rope_ ? 0.0 : std::numeric_limits<double>::infinity();
  info->findex[0] = -1;
  info->x[0] = impulse_;
}

void DistanceConstraint::applyUnitImpulse(std::size_t)
{
  for (std::size_t side = 0; side < 2; ++side)
    if (reacts(side))
      bodies()[side]->getSkeleton()->clearConstraintImpulses();
  if (reacts(0) && reacts(1) && mBodyNode1->getSkeleton() == mBodyNode2->getSkeleton()) {
    const auto skeleton = mBodyNode1->getSkeleton();
    skeleton->updateBiasImpulse(mBodyNode1, directions_[0], mBodyNode2, directions_[1]);
    skeleton->updateVelocityChange();
    return;
  }
  for (std::size_t side = 0; side < 2; ++side)
    if (reacts(side)) {
      const auto skeleton = bodies()[side]->getSkeleton();
      skeleton->updateBiasImpulse(bodies()[side], directions_[side]);
      skeleton->updateVelocityChange();
    }
}

void DistanceConstraint::getVelocityChange(double* change, bool with_force_mixing)
{
  change[0] = 0.0;
  for (std::size_t side = 0; side < 2; ++side)
    if (reacts(side) && bodies()[side]->getSkeleton()->isImpulseApplied())
      change[0] += directions_[side].dot(bodies()[side]->getBodyVelocityChange());
  if (with_force_mixing)
    change[0] += change[0] * mConstraintForceMixing;
}

void DistanceConstraint::set_impulse_applied(bool applied)
{
  for (std::size_t side = 0; side < 2; ++side)
    if (reacts(side))
      bodies()[side]->getSkeleton()->setImpulseApplied(applied);
}

void DistanceConstraint::applyImpulse(double* impulse)
{
  impulse_ = impulse[0];
  for (std::size_t side = 0; side < 2; ++side)
    if (bodies()[side] != nullptr)
      bodies()[side]->addConstraintImpulse(directions_[side] * impulse_);
}

bool DistanceConstraint::isActive() const
{
  return reacts(0) || reacts(1);
}

SkeletonPtr DistanceConstraint::getRootSkeleton() const
{
  return ConstraintBase::getRootSkeleton(bodies()[reacts(0) ? 0 : 1]->getSkeleton()->mUnionRootSkeleton.lock());
}

void DistanceConstraint::uniteSkeletons()
{
  if (!reacts(0) || !reacts(1) || mBodyNode1->getSkeleton() == mBodyNode2->getSkeleton())
    return;
  auto root1 = compressPath(mBodyNode1->getSkeleton()), root2 = compressPath(mBodyNode2->getSkeleton());
  if (root1 == root2)
    return;
  if (root1->mUnionSize < root2->mUnionSize)
    std::swap(root1, root2);
  root2->mUnionRootSkeleton = root1;
  root1->mUnionSize += root2->mUnionSize;
}

} // namespace pydart2::engine
