#pragma once

#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/GenericJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>

/// What the passes of TreeDynamics read and write in the bodies and joints of DART 6.12: the numbers that the engine's own
/// passes leave there, and the flags that say which are out of date. The members are protected: a derived class may name
/// them. A version that renames one does not compile; one that changes what a flag stands for fails `make test-solver`.
namespace pydart2::engine {

struct EntityMembers : dart::dynamics::Entity
{
  static constexpr auto transform_dirty = &EntityMembers::mNeedTransformUpdate;
  static constexpr auto velocity_dirty = &EntityMembers::mNeedVelocityUpdate;
  static constexpr auto acceleration_dirty = &EntityMembers::mNeedAccelerationUpdate;
  static constexpr auto transform_signal = &EntityMembers::mTransformUpdatedSignal;
  static constexpr auto velocity_signal = &EntityMembers::mVelocityChangedSignal;
  static constexpr auto acceleration_signal = &EntityMembers::mAccelerationChangedSignal;
};

struct FrameMembers : dart::dynamics::Frame
{
  static constexpr auto transform = &FrameMembers::mWorldTransform;
  static constexpr auto velocity = &FrameMembers::mVelocity;
  static constexpr auto acceleration = &FrameMembers::mAcceleration;
};

struct BodyMembers : dart::dynamics::BodyNode
{
  static constexpr auto partial_acceleration = &BodyMembers::mPartialAcceleration;
  static constexpr auto partial_acceleration_dirty = &BodyMembers::mIsPartialAccelerationDirty;
  static constexpr auto inertia = &BodyMembers::mArtInertia;
  static constexpr auto inertia_implicit = &BodyMembers::mArtInertiaImplicit;
  static constexpr auto update_inertia = &BodyMembers::updateArtInertia;
  static constexpr auto bias_force = &BodyMembers::mBiasForce;
  static constexpr auto force = &BodyMembers::mF;
  static constexpr auto constraint_impulse = &BodyMembers::mConstraintImpulse;
  static constexpr auto bias_impulse = &BodyMembers::mBiasImpulse;
  static constexpr auto velocity_change = &BodyMembers::mDelV;
  static constexpr auto impulse = &BodyMembers::mImpF;
  static constexpr auto others = &BodyMembers::mNonBodyNodeEntities;
  static constexpr auto jacobian_dirty = &BodyMembers::mIsBodyJacobianDirty;
  static constexpr auto jacobian_rate_dirty = &BodyMembers::mIsBodyJacobianSpatialDerivDirty;
  static constexpr auto world_jacobian_rate_dirty = &BodyMembers::mIsWorldJacobianClassicDerivDirty;
  static constexpr auto mark_jacobian = &BodyMembers::dirtyJacobian;
  static constexpr auto mark_jacobian_rate = &BodyMembers::dirtyJacobianDeriv;
};

struct JointMembers : dart::dynamics::Joint
{
  static constexpr auto properties = &JointMembers::mAspectProperties;
  static constexpr auto transform = &JointMembers::mT;
  static constexpr auto velocity = &JointMembers::mSpatialVelocity;
  static constexpr auto primary_acceleration = &JointMembers::mPrimaryAcceleration;
  static constexpr auto transform_dirty = &JointMembers::mNeedTransformUpdate;
  static constexpr auto velocity_dirty = &JointMembers::mNeedSpatialVelocityUpdate;
  static constexpr auto acceleration_dirty = &JointMembers::mNeedSpatialAccelerationUpdate;
  static constexpr auto primary_acceleration_dirty = &JointMembers::mNeedPrimaryAccelerationUpdate;
  static constexpr auto jacobian_dirty = &JointMembers::mIsRelativeJacobianDirty;
  static constexpr auto jacobian_rate_dirty = &JointMembers::mIsRelativeJacobianTimeDerivDirty;
  static constexpr auto add_impulse_terms = &JointMembers::updateConstrainedTerms;
};

struct BallJointMembers : dart::dynamics::BallJoint
{
  static constexpr auto turned = &BallJointMembers::mR;
};

struct FreeJointMembers : dart::dynamics::FreeJoint
{
  static constexpr auto moved = &FreeJointMembers::mQ;
};

template <class Space>
struct GenericJointMembers : dart::dynamics::GenericJoint<Space>
{
  using Members = GenericJointMembers;
  static constexpr auto state = &Members::mAspectState;
  static constexpr auto jacobian = &Members::mJacobian;
  static constexpr auto jacobian_rate = &Members::mJacobianDeriv;
  static constexpr auto inverse_inertia = &Members::mInvProjArtInertia;
  static constexpr auto inverse_inertia_implicit = &Members::mInvProjArtInertiaImplicit;
  static constexpr auto total_force = &Members::mTotalForce;
  static constexpr auto total_impulse = &Members::mTotalImpulse;
  static constexpr auto velocity_change = &Members::mVelocityChanges;
  static constexpr auto impulses = &Members::mImpulses;
  static constexpr auto constraint_impulses = &Members::mConstraintImpulses;
};

/// What of a skeleton, and of each of its trees, is out of date.
struct SkeletonMembers : dart::dynamics::Skeleton
{
  static auto& all(Skeleton& skeleton) { return (skeleton.*(&SkeletonMembers::mSkelCache)).mDirty; }
  static auto& tree(Skeleton& skeleton, std::size_t i) { return (skeleton.*(&SkeletonMembers::mTreeCache))[i].mDirty; }
};

} // namespace pydart2::engine
