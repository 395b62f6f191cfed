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
  forest_.clear();
  for (std::size_t i = 0; i < result.getNumContacts(); ++i)
    if (auto& contact = result.getContact(i); !(contact.penetrationDepth < 0.0) && !Contact::isZeroNormal(contact.normal))
      terms_.push_back(reader_.read(contact, nullptr));
  share_slip(terms_);
  std::array<BodyNode*, 2> pair{};
  std::array<const Body*, 2> bodies{};
  for (const auto& terms : terms_) {
    if (pair != terms.bodies) {
      pair = terms.bodies;
      bodies = {&look_at(*pair[0]), &look_at(*pair[1])};
    }
    if (bodies[0]->reactive || bodies[1]->reactive)
      contacts_.push_back({terms, bodies, {}});
    if (bodies[0]->reactive && bodies[1]->reactive)
      forest_.join(bodies[0]->skeleton, bodies[1]->skeleton);
  }
}

const DirectContacts::Body& DirectContacts::look_at(const BodyNode& body)
{
  if (const auto* known = bodies_.find(&body))
    return *known;
  const auto& pose = body.getWorldTransform();
  const Body made{body.isReactive(), body.getSkeleton().get(), &pose, pose.inverse(), &body.getSpatialVelocity()};
  return bodies_.try_emplace(&body, made).first;
}

bool DirectContacts::group_with(const Constraints& constraints)
{
  numbers_.clear();
  std::size_t entry = 0, count = 0;
  const auto add = [&](const Skeleton* root) {
    const auto [group, is_new] = numbers_.try_emplace(root, count);
    if (is_new && ++count > groups_.size())
      groups_.emplace_back();
    groups_[group].push_back(entry++);
  };
  for (auto& members : groups_)
    members.clear();
  for (const auto& contact : contacts_)
    add(forest_.root(contact.bodies[contact.bodies[0]->reactive ? 0 : 1]->skeleton));
  for (const auto& constraint : constraints) {
    const auto* skeleton = constraint->getRootSkeleton().get();
    const auto* root = forest_.root(skeleton);
    if (forest_.above(skeleton) != root)
      return false;
    add(root);
  }
  groups_.resize(count);
  return true;
}

void DirectContacts::read_rows(
    std::size_t number, engine::Rows& rows, double time_step, const dart::constraint::ConstraintInfo& info)
{
  auto& entry = contacts_[number];
  const auto& terms = entry.terms;
  const auto& contact = *terms.contact;
  const int dimension = static_cast<int>(this->dimension(number));
  engine::begin_contact(rows);
  auto& bodies = rows.bodies;
  bodies.bodies = terms.bodies;
  if (dimension == 3) {
    entry.tangents = tangents_of(terms);
    bodies.slip = {terms.slip[1], terms.slip[0]};
  }
  for (const std::size_t side : {0, 1}) {
    const auto& body = *entry.bodies[side];
    Vector3d point;
    point.noalias() = body.inverse * contact.point;
    auto& directions = bodies.directions[side];
    directions.resize(6, dimension);
    for (int row = 0; row < dimension; ++row) {
      const Vector3d direction = row == 0 ? contact.normal : Vector3d(entry.tangents.col(row - 1));
      put(*body.pose, point, side == 0 ? direction : Vector3d(-direction), directions, row);
    }
  }
  for (int row = 0; row < dimension; ++row) {
    const double friction = row == 0 ? 0.0 : terms.friction[static_cast<std::size_t>(2 - row)];
    info.lo[row] = -friction;
    info.hi[row] = friction;
    info.findex[row] = row == 0 ? -1 : 0;
    info.b[row] = 0.0;
    for (const std::size_t side : {0, 1})
      info.b[row] -= bodies.directions[side].col(row).dot(*entry.bodies[side]->velocity);
  }
  info.lo[0] = 0.0;
  info.hi[0] = std::numeric_limits<double>::infinity();
  info.b[0] = parting_speed(terms, info.b[0], engine_correction(terms.depth, time_step));
}

void DirectContacts::store_force(std::size_t number, const double* impulses, double time_step) const
{
  const auto& entry = contacts_[number];
  auto& contact = *entry.terms.contact;
  contact.force = contact.normal * impulses[0] / time_step;
  if (!entry.terms.has_friction())
    return;
  contact.force += entry.tangents.col(0) * impulses[1] / time_step;
  contact.force += entry.tangents.col(1) * impulses[2] / time_step;
}

dart::constraint::ConstraintBasePtr DirectContacts::make_constraint(std::size_t number, double time_step) const
{
  const auto& terms = contacts_[number].terms;
  dart::constraint::ConstraintBasePtr made = std::make_shared<ContactConstraint>(*terms.contact, time_step);
  engine::set_slip(*made, {terms.slip[1], terms.slip[0]});
  made->update();
  return made;
}

} // namespace pydart2
