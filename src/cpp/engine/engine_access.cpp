#include "engine/engine_access.hpp"

#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/constraint/JointConstraint.hpp>
#include <dart/constraint/JointCoulombFrictionConstraint.hpp>
#include <dart/constraint/MimicMotorConstraint.hpp>
#include <dart/constraint/SoftContactConstraint.hpp>
#include <dart/constraint/WeldJointConstraint.hpp>
#include <typeinfo>

#include "engine/distance_constraint.hpp"

namespace pydart2::engine {

namespace {

using namespace dart::constraint;
using namespace dart::dynamics;

// An explicit instantiation may name private members (C++17 standard, 17.7.2/12). Each one below defines the function
// member(tag) that its tag declares; it returns the pointer to the member. Where the engine renames a member or changes
// its type, this file does not compile.

template <class Tag, typename Tag::type pointer>
struct Reveal
{
  friend constexpr typename Tag::type member(Tag) { return pointer; }
};

template <class Class, class Type>
struct Private
{
  using type = Type Class::*;
};

using Normals = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using BallJacobian = Eigen::Matrix<double, 3, 6>;
using Weld = WeldJointConstraint;
using Ball = BallJointConstraint;
using Friction = JointCoulombFrictionConstraint;
using Mimic = MimicMotorConstraint;
using Soft = SoftContactConstraint;
using SoftJacobians = dart::common::aligned_vector<Eigen::Vector6d>;

struct ContactBodyA : Private<ContactConstraint, BodyNode*> { friend constexpr type member(ContactBodyA); };
struct ContactBodyB : Private<ContactConstraint, BodyNode*> { friend constexpr type member(ContactBodyB); };
struct ContactNormalA : Private<ContactConstraint, Normals> { friend constexpr type member(ContactNormalA); };
struct ContactNormalB : Private<ContactConstraint, Normals> { friend constexpr type member(ContactNormalB); };
struct PrimarySlip : Private<ContactConstraint, double> { friend constexpr type member(PrimarySlip); };
struct SecondarySlip : Private<ContactConstraint, double> { friend constexpr type member(SecondarySlip); };
struct ContactOf
{
  using type = const dart::collision::Contact& (ContactConstraint::*)() const;
  friend constexpr type member(ContactOf);
};
struct Tangents
{
  using type = Eigen::Matrix<double, 3, 2> (ContactConstraint::*)(const Eigen::Vector3d&);
  friend constexpr type member(Tangents);
};
struct SoftBody1 : Private<Soft, BodyNode*> { friend constexpr type member(SoftBody1); };
struct SoftBody2 : Private<Soft, BodyNode*> { friend constexpr type member(SoftBody2); };
struct SoftPoint1 : Private<Soft, PointMass*> { friend constexpr type member(SoftPoint1); };
struct SoftPoint2 : Private<Soft, PointMass*> { friend constexpr type member(SoftPoint2); };
struct SoftJacobians1 : Private<Soft, SoftJacobians> { friend constexpr type member(SoftJacobians1); };
struct SoftJacobians2 : Private<Soft, SoftJacobians> { friend constexpr type member(SoftJacobians2); };
struct DynamicBody1 : Private<DynamicJointConstraint, BodyNode*> { friend constexpr type member(DynamicBody1); };
struct DynamicBody2 : Private<DynamicJointConstraint, BodyNode*> { friend constexpr type member(DynamicBody2); };
struct BallJacobian1 : Private<Ball, BallJacobian> { friend constexpr type member(BallJacobian1); };
struct BallJacobian2 : Private<Ball, BallJacobian> { friend constexpr type member(BallJacobian2); };
struct WeldJacobian1 : Private<Weld, const Eigen::Matrix6d> { friend constexpr type member(WeldJacobian1); };
struct WeldJacobian2 : Private<Weld, Eigen::Matrix6d> { friend constexpr type member(WeldJacobian2); };
struct BallTarget : Private<Ball, Eigen::Vector3d> { friend constexpr type member(BallTarget); };
struct WeldTarget : Private<Weld, Eigen::Isometry3d> { friend constexpr type member(WeldTarget); };
struct BallViolation : Private<Ball, Eigen::Vector3d> { friend constexpr type member(BallViolation); };
struct WeldViolation : Private<Weld, Eigen::Vector6d> { friend constexpr type member(WeldViolation); };
struct BallImpulse : Private<Ball, double[3]> { friend constexpr type member(BallImpulse); };
struct WeldImpulse : Private<Weld, double[6]> { friend constexpr type member(WeldImpulse); };
struct LimitJoint : Private<JointConstraint, Joint*> { friend constexpr type member(LimitJoint); };
struct LimitActive : Private<JointConstraint, Eigen::Matrix<bool, 6, 1>> { friend constexpr type member(LimitActive); };
struct FrictionJoint : Private<Friction, Joint*> { friend constexpr type member(FrictionJoint); };
struct FrictionActive : Private<Friction, bool[6]> { friend constexpr type member(FrictionActive); };
struct MimicJoint : Private<Mimic, Joint*> { friend constexpr type member(MimicJoint); };
struct MimicActive : Private<Mimic, bool[6]> { friend constexpr type member(MimicActive); };

template struct Reveal<ContactBodyA, &ContactConstraint::mBodyNodeA>;
template struct Reveal<ContactBodyB, &ContactConstraint::mBodyNodeB>;
template struct Reveal<ContactNormalA, &ContactConstraint::mSpatialNormalA>;
template struct Reveal<ContactNormalB, &ContactConstraint::mSpatialNormalB>;
template struct Reveal<PrimarySlip, &ContactConstraint::mPrimarySlipCompliance>;
template struct Reveal<SecondarySlip, &ContactConstraint::mSecondarySlipCompliance>;
template struct Reveal<ContactOf, &ContactConstraint::getContact>;
template struct Reveal<Tangents, &ContactConstraint::getTangentBasisMatrixODE>;
template struct Reveal<SoftBody1, &Soft::mBodyNode1>;
template struct Reveal<SoftBody2, &Soft::mBodyNode2>;
template struct Reveal<SoftPoint1, &Soft::mPointMass1>;
template struct Reveal<SoftPoint2, &Soft::mPointMass2>;
template struct Reveal<SoftJacobians1, &Soft::mJacobians1>;
template struct Reveal<SoftJacobians2, &Soft::mJacobians2>;
template struct Reveal<DynamicBody1, &DynamicJointConstraint::mBodyNode1>;
template struct Reveal<DynamicBody2, &DynamicJointConstraint::mBodyNode2>;
template struct Reveal<BallJacobian1, &Ball::mJacobian1>;
template struct Reveal<BallJacobian2, &Ball::mJacobian2>;
template struct Reveal<WeldJacobian1, &Weld::mJacobian1>;
template struct Reveal<WeldJacobian2, &Weld::mJacobian2>;
template struct Reveal<BallTarget, &Ball::mOffset2>;
template struct Reveal<WeldTarget, &Weld::mRelativeTransform>;
template struct Reveal<BallViolation, &Ball::mViolation>;
template struct Reveal<WeldViolation, &Weld::mViolation>;
template struct Reveal<BallImpulse, &Ball::mOldX>;
template struct Reveal<WeldImpulse, &Weld::mOldX>;
template struct Reveal<LimitJoint, &JointConstraint::mJoint>;
template struct Reveal<LimitActive, &JointConstraint::mActive>;
template struct Reveal<FrictionJoint, &Friction::mJoint>;
template struct Reveal<FrictionActive, &Friction::mActive>;
template struct Reveal<MimicJoint, &Mimic::mJoint>;
template struct Reveal<MimicActive, &Mimic::mActive>;

constexpr auto lanes = SumOrder::lanes, halves = SumOrder::halves, sequence = SumOrder::sequence;
constexpr std::array<SumOrder, 6> contact_orders{lanes, lanes, lanes};
constexpr std::array<SumOrder, 6> ball_orders{sequence, sequence, halves};
constexpr std::array<SumOrder, 6> weld_orders{sequence, sequence, sequence, sequence, sequence, sequence};

BodyRows contact_rows(const ContactConstraint& contact)
{
  return {
      contact_orders,
      {contact.*member(ContactBodyA()), contact.*member(ContactBodyB())},
      {contact.*member(ContactNormalA()), contact.*member(ContactNormalB())},
      {contact.*member(PrimarySlip()), contact.*member(SecondarySlip())}};
}

Directions columns(const SoftJacobians& jacobians)
{
  Directions directions(6, static_cast<Eigen::Index>(jacobians.size()));
  for (Eigen::Index i = 0; i < directions.cols(); ++i)
    directions.col(i) = jacobians[static_cast<std::size_t>(i)];
  return directions;
}

/// Of a contact with a soft body; false within a skeleton, where the engine lets one side's impulse take the place of
/// the other's.
bool read_soft_contact(const Soft& contact, BodyRows& rows)
{
  auto *body1 = contact.*member(SoftBody1()), *body2 = contact.*member(SoftBody2());
  if (body1->getSkeleton() == body2->getSkeleton())
    return false;
  rows = {
      contact_orders,
      {body1, body2},
      {columns(contact.*member(SoftJacobians1())), columns(contact.*member(SoftJacobians2()))},
      {0.0, 0.0},
      {contact.*member(SoftPoint1()), contact.*member(SoftPoint2())}};
  return true;
}

/// Of joints between two bodies: the first moves with the joint, the second against it.
template <class Jacobian>
BodyRows joint_rows(
    const DynamicJointConstraint& joint,
    const std::array<SumOrder, 6>& orders,
    const Jacobian& first,
    const Jacobian& second)
{
  return {
      orders,
      {joint.*member(DynamicBody1()), joint.*member(DynamicBody2())},
      {first.transpose(), -second.transpose()}};
}

template <class Active>
JointRows dof_rows(Joint* joint, const Active& active)
{
  JointRows rows{joint, {}};
  for (std::size_t i = 0; i < rows.active.size(); ++i)
    rows.active[i] = active[static_cast<int>(i)];
  return rows;
}

} // namespace

void set_target(ConstraintBase& constraint, const Eigen::Isometry3d& target)
{
  if (auto* ball = dynamic_cast<Ball*>(&constraint))
    ball->*member(BallTarget()) = target.translation();
  else if (auto* weld = dynamic_cast<Weld*>(&constraint))
    weld->*member(WeldTarget()) = target;
  else if (auto* distance = dynamic_cast<DistanceConstraint*>(&constraint))
    distance->set_point2(target.translation());
}

void scale_error(ConstraintBase& constraint, double factor)
{
  if (auto* ball = dynamic_cast<Ball*>(&constraint))
    ball->*member(BallViolation()) *= factor;
  else if (auto* weld = dynamic_cast<Weld*>(&constraint))
    weld->*member(WeldViolation()) *= factor;
  else if (auto* distance = dynamic_cast<DistanceConstraint*>(&constraint))
    distance->scale_error(factor);
}

void set_slip(ConstraintBase& constraint, const std::array<double, 2>& slip)
{
  auto& contact = dynamic_cast<ContactConstraint&>(constraint);
  contact.*member(PrimarySlip()) = slip[0];
  contact.*member(SecondarySlip()) = slip[1];
}

void scale_slip(ConstraintBase& constraint, double factor)
{
  auto& contact = dynamic_cast<ContactConstraint&>(constraint);
  contact.*member(PrimarySlip()) *= factor;
  contact.*member(SecondarySlip()) *= factor;
}

void store_impulses(ConstraintBase& constraint, const double* impulses)
{
  if (auto* ball = dynamic_cast<Ball*>(&constraint))
    std::copy_n(impulses, 3, ball->*member(BallImpulse()));
  else if (auto* weld = dynamic_cast<Weld*>(&constraint))
    std::copy_n(impulses, 6, weld->*member(WeldImpulse()));
  else if (auto* distance = dynamic_cast<DistanceConstraint*>(&constraint))
    distance->store_impulse(impulses[0]);
}

Eigen::Vector6d impulse_on_first(const ConstraintBase& constraint)
{
  if (const auto* ball = dynamic_cast<const Ball*>(&constraint))
    return (ball->*member(BallJacobian1())).transpose() * Eigen::Map<const Eigen::Vector3d>(ball->*member(BallImpulse()));
  if (const auto* weld = dynamic_cast<const Weld*>(&constraint))
    return (weld->*member(WeldJacobian1())).transpose() * Eigen::Map<const Eigen::Vector6d>(weld->*member(WeldImpulse()));
  if (const auto* distance = dynamic_cast<const DistanceConstraint*>(&constraint))
    return distance->direction1() * distance->impulse();
  return Eigen::Vector6d::Zero();
}

void read_rows(const ConstraintBase& constraint, Rows& rows)
{
  const auto& type = typeid(constraint);
  rows.kind = Rows::Kind::unknown;
  if (type == typeid(ContactConstraint)) {
    rows.kind = Rows::Kind::bodies;
    rows.bodies = contact_rows(static_cast<const ContactConstraint&>(constraint));
    rows.force_mixing = ContactConstraint::getConstraintForceMixing();
  } else if (type == typeid(Soft)) {
    if (!read_soft_contact(static_cast<const Soft&>(constraint), rows.bodies))
      return;
    rows.kind = Rows::Kind::bodies;
    rows.force_mixing = Soft::getConstraintForceMixing();
  } else if (type == typeid(Weld)) {
    const auto& weld = static_cast<const Weld&>(constraint);
    rows.kind = Rows::Kind::bodies;
    rows.bodies = joint_rows(weld, weld_orders, weld.*member(WeldJacobian1()), weld.*member(WeldJacobian2()));
    rows.force_mixing = DynamicJointConstraint::getConstraintForceMixing();
  } else if (type == typeid(Ball)) {
    const auto& ball = static_cast<const Ball&>(constraint);
    rows.kind = Rows::Kind::bodies;
    rows.bodies = joint_rows(ball, ball_orders, ball.*member(BallJacobian1()), ball.*member(BallJacobian2()));
    rows.force_mixing = DynamicJointConstraint::getConstraintForceMixing();
  } else if (type == typeid(DistanceConstraint)) {
    rows.kind = Rows::Kind::bodies;
    rows.bodies = static_cast<const DistanceConstraint&>(constraint).rows();
    rows.force_mixing = DynamicJointConstraint::getConstraintForceMixing();
  } else if (type == typeid(JointConstraint)) {
    const auto& limit = static_cast<const JointConstraint&>(constraint);
    rows.kind = Rows::Kind::joint;
    rows.joint = dof_rows(limit.*member(LimitJoint()), limit.*member(LimitActive()));
    rows.force_mixing = JointConstraint::getConstraintForceMixing();
  } else if (type == typeid(Friction)) {
    const auto& friction = static_cast<const Friction&>(constraint);
    rows.kind = Rows::Kind::joint;
    rows.joint = dof_rows(friction.*member(FrictionJoint()), friction.*member(FrictionActive()));
    rows.force_mixing = Friction::getConstraintForceMixing();
  } else if (type == typeid(Mimic)) {
    const auto& mimic = static_cast<const Mimic&>(constraint);
    rows.kind = Rows::Kind::joint;
    rows.joint = dof_rows(mimic.*member(MimicJoint()), mimic.*member(MimicActive()));
    rows.force_mixing = Mimic::getConstraintForceMixing();
  }
}

void begin_contact(Rows& rows)
{
  rows.kind = Rows::Kind::bodies;
  rows.bodies.orders = contact_orders;
  rows.bodies.slip = {0.0, 0.0};
  rows.bodies.points = {};
  rows.force_mixing = ContactConstraint::getConstraintForceMixing();
}

const dart::collision::Contact* contact(const ConstraintBase& constraint)
{
  if (typeid(constraint) != typeid(ContactConstraint))
    return nullptr;
  return &(static_cast<const ContactConstraint&>(constraint).*member(ContactOf()))();
}

bool store_force(ConstraintBase& constraint, const double* impulses, double time_step)
{
  const auto* found = contact(constraint);
  if (found == nullptr)
    return false;
  auto& contact = const_cast<dart::collision::Contact&>(*found); // the engine's result, which its constraint refers to
  contact.force = contact.normal * impulses[0] / time_step;
  if (constraint.getDimension() == 1) // no friction
    return true;
  const auto tangents = (static_cast<ContactConstraint&>(constraint).*member(Tangents()))(contact.normal);
  contact.force += tangents.col(0) * impulses[1] / time_step;
  contact.force += tangents.col(1) * impulses[2] / time_step;
  return true;
}

} // namespace pydart2::engine
