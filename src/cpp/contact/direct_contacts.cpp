#include "contact/direct_contacts.hpp"

#include <algorithm>
#include <dart/constraint/ContactConstraint.hpp>
#include <limits>

namespace pydart2 {

namespace {

using dart::collision::Contact;
using dart::constraint::ContactConstraint;
using dart::dynamics::BodyNode;
using dart::dynamics::Skeleton;
using Eigen::Vector3d;

/// The second lies across the normal and the first direction of friction, the first, a quarter of a turn on, along it.
Eigen::Matrix<double, 3, 2> tangents_of(const ContactTerms& terms)
{
  constexpr double nearly_zero = 1e-12; // of a squared length
  const Vector3d& n = terms.contact->normal;
  Vector3d tangent = n.cross(terms.first_direction);
  for (const auto& other : {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()})
    if (tangent.squaredNorm() < nearly_zero)
      tangent = n.cross(Vector3d(other));
  tangent.normalize();
  Eigen::Matrix<double, 3, 2> tangents;
  tangents.col(0) = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2.0, n)) * tangent;
  tangents.col(1) = tangent;
  return tangents;
}

/// An impulse at a point of a body along a direction of the world, in the body's frame.
void put(const Eigen::Isometry3d& pose, const Vector3d& point, const Vector3d& direction, engine::Directions& out, int column)
{
  Vector3d along;
  along.noalias() = pose.linear().transpose() * direction;
  out.col(column).head<3>() = point.cross(along);
  out.col(column).tail<3>() = along;
}

} // namespace

void DirectContacts::read(dart::collision::CollisionResult& result)
{
  reader_.begin(false, nullptr);
  terms_.clear();
  contacts_.clear();
  bodies_.clear();
  united_.clear();
  for (std::size_t i = 0; i < result.getNumContacts(); ++i)
    if (auto& contact = result.getContact(i); !(contact.penetrationDepth < 0.0) && !Contact::isZeroNormal(contact.normal))
      terms_.push_back(reader_.read(contact, nullptr));
  share_slip(terms_);
  for (const auto& terms : terms_) {
    const auto &a = look_at(*terms.bodies[0]), &b = look_at(*terms.bodies[1]);
    if (a.reactive || b.reactive)
      contacts_.push_back({terms, {&a, &b}, {}});
    if (a.reactive && b.reactive)
      united_[root(b.skeleton)] = root(a.skeleton);
  }
}

const DirectContacts::Body& DirectContacts::look_at(const BodyNode& body)
{
  const auto [known, is_new] = bodies_.try_emplace(&body);
  if (is_new) {
    known->second = {body.isReactive(), body.getSkeleton().get(), body.getWorldTransform().inverse()};
    united_.emplace(known->second.skeleton, known->second.skeleton);
  }
  return known->second;
}

const Skeleton* DirectContacts::root(const Skeleton* skeleton)
{
  while (united_.at(skeleton) != skeleton)
    skeleton = united_.at(skeleton);
  return skeleton;
}

const std::vector<std::vector<int>>& DirectContacts::groups()
{
  std::unordered_map<const Skeleton*, std::size_t> numbers;
  groups_.clear();
  for (int i = 0; i < static_cast<int>(contacts_.size()); ++i) {
    const auto& bodies = at(i).bodies;
    const auto* skeleton = root((bodies[0]->reactive ? bodies[0] : bodies[1])->skeleton);
    const auto [number, is_new] = numbers.emplace(skeleton, groups_.size());
    if (is_new)
      groups_.emplace_back();
    groups_[number->second].push_back(i);
  }
  return groups_;
}

void DirectContacts::read_rows(int number, engine::Rows& rows, double time_step, Row* out)
{
  auto& entry = at(number);
  const auto& terms = entry.terms;
  const auto& contact = *terms.contact;
  const int dimension = this->dimension(number);
  engine::begin_contact(rows);
  auto& bodies = rows.bodies;
  bodies.bodies = terms.bodies;
  if (dimension == 3) {
    entry.tangents = tangents_of(terms);
    bodies.slip = {terms.slip[1], terms.slip[0]};
  }
  for (const std::size_t side : {0, 1}) {
    const auto& pose = terms.bodies[side]->getWorldTransform();
    Vector3d point;
    point.noalias() = entry.bodies[side]->inverse * contact.point;
    auto& directions = bodies.directions[side];
    directions.resize(6, dimension);
    for (int row = 0; row < dimension; ++row) {
      const Vector3d direction = row == 0 ? contact.normal : Vector3d(entry.tangents.col(row - 1));
      put(pose, point, side == 0 ? direction : Vector3d(-direction), directions, row);
    }
  }
  for (int row = 0; row < dimension; ++row) {
    const double friction = row == 0 ? 0.0 : terms.friction[static_cast<std::size_t>(2 - row)];
    out[row] = {0.0, -friction, row == 0 ? std::numeric_limits<double>::infinity() : friction, row > 0};
    for (const std::size_t side : {0, 1})
      out[row].b -= bodies.directions[side].col(row).dot(terms.bodies[side]->getSpatialVelocity());
  }
  out[0].lo = 0.0;
  out[0].b = parting_speed(terms, out[0].b, engine_correction(terms.depth, time_step));
}

void DirectContacts::store_force(int number, const double* impulses, double time_step) const
{
  const auto& entry = at(number);
  auto& contact = *entry.terms.contact;
  contact.force = contact.normal * impulses[0] / time_step;
  if (!entry.terms.has_friction())
    return;
  contact.force += entry.tangents.col(0) * impulses[1] / time_step;
  contact.force += entry.tangents.col(1) * impulses[2] / time_step;
}

} // namespace pydart2
