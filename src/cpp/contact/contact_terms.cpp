#include "contact/contact_terms.hpp"

#include <algorithm>
#include <dart/collision/CollisionObject.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <map>

namespace pydart2 {

namespace {

using dart::constraint::ContactConstraint;
using Eigen::Vector3d;

// As in the engine's ContactConstraint.
constexpr double least_friction = 1e-3, least_restitution = 1e-3, least_bounce = 0.1, fastest_bounce = 100.0;
constexpr double nearly_zero = 1e-12; // of a squared length

/// Two tangents, as the engine chooses them.
std::array<Vector3d, 3> basis(const Vector3d& normal, const Vector3d& first_direction)
{
  Vector3d tangent = first_direction.cross(normal);
  for (const auto& other : {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()})
    if (tangent.squaredNorm() < nearly_zero)
      tangent = Vector3d(other).cross(normal);
  tangent.normalize();
  return {normal, tangent, normal.cross(tangent)};
}

} // namespace

bool ContactTerms::has_friction() const
{
  return friction[0] > least_friction || friction[1] > least_friction;
}

void ContactReader::begin(bool same, const FreeBodies* free)
{
  free_ = free;
  shapes_ = {};
  if (!same)
    items_.clear();
}

const ContactReader::Shape& ContactReader::of_side(std::size_t side, const dart::collision::CollisionObject& object)
{
  auto& known = shapes_[side];
  if (known.object != &object)
    known = shape(object);
  return known;
}

const ContactReader::Shape& ContactReader::of_item(int item, const dart::collision::CollisionObject& object)
{
  const auto i = static_cast<std::size_t>(item);
  if (i >= items_.size())
    items_.resize(i + 1);
  auto& known = items_[i];
  if (!known.known) {
    known = shape(object);
    known.known = known.first_direction.isZero(0.0); // which turns with the shape
  }
  return known;
}

bool ContactTerms::bounces() const
{
  return restitution > least_restitution;
}

ContactReader::Shape ContactReader::shape(const dart::collision::CollisionObject& object) const
{
  Shape shape;
  shape.object = &object;
  const auto* node = object.getShapeFrame()->asShapeNode();
  if (node == nullptr)
    return shape;
  shape.body = const_cast<dart::dynamics::BodyNode*>(node->getBodyNodePtr().get());
  if (free_ != nullptr)
    shape.free = free_->find(shape.body);
  const auto* aspect = node->getDynamicsAspect();
  if (aspect == nullptr)
    return shape;
  const auto not_negative = [](double slip) { return std::max(slip, 0.0); }; // -1 stands for the engine's default
  shape.friction = {aspect->getPrimaryFrictionCoeff(), aspect->getSecondaryFrictionCoeff()};
  shape.slip = {not_negative(aspect->getPrimarySlipCompliance()), not_negative(aspect->getSecondarySlipCompliance())};
  shape.restitution = aspect->getRestitutionCoeff();
  if (const auto& direction = aspect->getFirstFrictionDirection(); !direction.isZero(0.0)) {
    const auto* frame = aspect->getFirstFrictionDirectionFrame();
    shape.first_direction = (frame == nullptr ? node : frame)->getWorldTransform().linear() * direction;
  }
  return shape;
}

ContactTerms ContactReader::read(dart::collision::Contact& contact, const native::Touch* touch)
{
  if (touch != nullptr) // before there are references
    of_item(std::max(touch->item_a, touch->item_b), touch->item_a > touch->item_b ? *touch->a : *touch->b);
  const auto& a = touch == nullptr ? of_side(0, *contact.collisionObject1) : of_item(touch->item_a, *touch->a);
  const auto& b = touch == nullptr ? of_side(1, *contact.collisionObject2) : of_item(touch->item_b, *touch->b);
  const bool a_has = a.first_direction.squaredNorm() >= nearly_zero, b_has = b.first_direction.squaredNorm() >= nearly_zero;
  const bool take_a = a_has && (!b_has || a.friction[0] <= b.friction[0]);
  const Vector3d first = take_a ? a.first_direction : b_has ? b.first_direction : Vector3d(Vector3d::UnitZ());
  ContactTerms terms;
  terms.contact = &contact;
  terms.bodies = {a.body, b.body};
  terms.free = {a.free, b.free};
  terms.first_direction = take_a || b_has ? first.normalized() : first;
  terms.directions = basis(contact.normal, first);
  for (const std::size_t i : {0, 1}) { // the first tangent lies across the first direction
    terms.friction[1 - i] = std::min(a.friction[i], b.friction[i]);
    terms.slip[1 - i] = a.slip[i] + b.slip[i];
  }
  terms.restitution = a.restitution * b.restitution;
  terms.depth = contact.penetrationDepth;
  return terms;
}

void share_slip(std::vector<ContactTerms>& contacts)
{
  const auto slips = [](const ContactTerms& contact) { return contact.slip[0] > 0.0 || contact.slip[1] > 0.0; };
  if (std::none_of(contacts.begin(), contacts.end(), slips))
    return;
  using Pair = std::pair<dart::collision::CollisionObject*, dart::collision::CollisionObject*>;
  const auto key = [](const ContactTerms& contact) {
    return Pair(std::minmax(contact.contact->collisionObject1, contact.contact->collisionObject2));
  };
  std::map<Pair, int> counts; // looked up only
  for (const auto& contact : contacts)
    ++counts[key(contact)];
  for (auto& contact : contacts)
    for (auto& slip : contact.slip)
      slip *= counts[key(contact)];
}

double engine_correction(double depth, double time_step)
{
  const double over = std::max(0.0, depth - ContactConstraint::getErrorAllowance());
  const double rate = ContactConstraint::getErrorReductionParameter() * (1.0 / time_step); // to the bit
  return std::min(over * rate, ContactConstraint::getMaxErrorReductionVelocity());
}

double parting_speed(const ContactTerms& contact, double approach, double correction)
{
  const double bounce = contact.restitution > least_restitution ? approach * contact.restitution : 0.0;
  return approach + (bounce > least_bounce && bounce > correction ? std::min(bounce, fastest_bounce) : correction);
}

} // namespace pydart2
