#pragma once

#include <Eigen/Core>
#include <array>
#include <dart/collision/Contact.hpp>
#include <dart/constraint/ConstraintBase.hpp>
#include <dart/dynamics/GenericJoint.hpp>

/// What the fast solver must know of the engine's objects and the engine keeps to itself: the rows of its constraints
/// and the inverse projected inertia of its joints. It changes nothing but the force of a contact.
namespace pydart2::engine {

/// Up to six rows of a constraint at one body: column i is the impulse on the body, a wrench in its frame, that goes
/// with a unit impulse of row i, and by duality what row i reads of the body's velocity change.
using Directions = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

/// The order in which the engine, through Eigen, sums the six terms of direction . velocity; the last bits depend on
/// it.
enum class SumOrder {
  lanes,   ///< (0 + (2 + 4)) + (1 + (3 + 5)): contacts, whose directions are contiguous columns.
  halves,  ///< (0 + (1 + 2)) + (3 + (4 + 5)): the third row of a ball joint's 3x6 Jacobian.
  sequence ///< One after the other: its first two rows, and a weld joint's 6x6 Jacobian.
};

/// A constraint of one or two bodies: contact, also of soft ones, ball joint, weld joint, distance. A missing body is null.
struct BodyRows
{
  std::array<SumOrder, 6> orders; ///< Of each row.
  std::array<dart::dynamics::BodyNode*, 2> bodies;
  std::array<Directions, 2> directions;
  std::array<double, 2> slip{0.0, 0.0}; ///< A contact's slip compliance in its two tangential rows.
  std::array<dart::dynamics::PointMass*, 2> points{}; ///< Of soft bodies, which the linear parts act on in their place.
};

/// A constraint of the degrees of freedom of one joint: limits and servo, Coulomb friction, mimic motor.
struct JointRows
{
  dart::dynamics::Joint* joint;
  std::array<bool, 6> active; ///< Which of them have a row.
};

/// What a constraint is made of, and how much of a diagonal element its force mixing adds.
struct Rows
{
  enum class Kind { bodies, joint, unknown } kind = Kind::unknown;
  BodyRows bodies;
  JointRows joint;
  double force_mixing = 0.0;
};

/// The rows of a constraint; unknown for classes that are not listed above and for classes derived from them.
void read_rows(const dart::constraint::ConstraintBase& constraint, Rows& rows);

/// Begins the rows of a contact between rigid bodies that has no constraint.
void begin_contact(Rows& rows);

/// The contact of a contact constraint between rigid bodies, null for other constraints.
const dart::collision::Contact* contact(const dart::constraint::ConstraintBase& constraint);

/// Stores the force that goes with the impulses of a contact constraint's rows in its contact, as its applyImpulse()
/// does; false, and nothing, for other constraints.
bool store_force(dart::constraint::ConstraintBase& constraint, const double* impulses, double time_step);

/// Where in the world a ball joint or distance constraint without a second body holds its point, or a weld its body.
void set_target(dart::constraint::ConstraintBase& constraint, const Eigen::Isometry3d& target);

/// Scales the error that a ball or weld joint or a distance constraint has found, and is about to reduce.
void scale_error(dart::constraint::ConstraintBase& constraint, double factor);

/// Sets the slip compliance of a contact's tangential rows.
void set_slip(dart::constraint::ConstraintBase& contact, const std::array<double, 2>& slip);

/// Scales the slip compliance of a contact, which the engine has multiplied by the number of contacts of its two shapes.
void scale_slip(dart::constraint::ConstraintBase& constraint, double factor);

/// Lets a ball or weld joint or a distance constraint know the impulses of its rows, as its applyImpulse() does, and does
/// not apply them.
void store_impulses(dart::constraint::ConstraintBase& constraint, const double* impulses);

/// What a ball or weld joint or a distance constraint did to its first body in the last step: moment and force times the step, in the
/// body's frame.
Eigen::Vector6d impulse_on_first(const dart::constraint::ConstraintBase& constraint);

/// (J' I J)^-1 of a joint, I the articulated inertia of its child body without implicit damping and springs. Valid once
/// the articulated inertia is up to date (BodyNode::getArticulatedInertia). The member is protected: a derived class
/// may name it.
template <class Space>
struct InverseProjectedInertia : dart::dynamics::GenericJoint<Space>
{
  static const typename Space::Matrix& of(const dart::dynamics::GenericJoint<Space>& joint)
  {
    return joint.*(&InverseProjectedInertia::mInvProjArtInertia);
  }
};

} // namespace pydart2::engine
