#include "contact/contact_memory.hpp"

#include <algorithm>
#include <cmath>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/Contact.hpp>
#include <dart/dynamics/ShapeNode.hpp>

namespace pydart2 {

namespace {

using dart::constraint::ConstraintBase;
using engine::Rows;

constexpr double part_of_size = 0.02;
constexpr long numbers_per_entry = 12;
constexpr std::size_t joint_part = 0, pair_part = 1; // of constraints; shapes are counted from 2

/// The directions of a contact's rows, seen from the world.
Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 6> directions(const Rows& rows)
{
  const auto* body = rows.bodies.bodies[0];
  return body->getWorldTransform().linear() * rows.bodies.directions[0].bottomRows<3>();
}

} // namespace

void ContactMemory::begin_step(const std::vector<dart::dynamics::SkeletonPtr>& skeletons)
{
  before_.swap(now_);
  now_.clear();
  for (auto& entry : before_)
    entry.used = false;
  const auto less = [](const Entry& x, const Entry& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); };
  std::stable_sort(before_.begin(), before_.end(), less);
  order_.clear();
  for (std::size_t i = 0; i < skeletons.size(); ++i)
    order_.emplace(skeletons[i].get(), i);
}

ContactMemory::Place ContactMemory::place(const dart::dynamics::BodyNode* body, std::size_t part) const
{
  if (body == nullptr)
    return -1.0;
  const auto found = order_.find(body->getSkeleton().get());
  const double skeleton = found == order_.end() ? -1.0 : static_cast<double>(found->second);
  constexpr double most = 65536.0; // bodies of a skeleton and parts of a body: the sum is exact in a double
  return (skeleton * most + static_cast<double>(body->getIndexInSkeleton())) * 1024.0 + static_cast<double>(part % 1024);
}

ContactMemory::Place ContactMemory::shape_place(const dart::dynamics::ShapeFrame& shape) const
{
  const auto* node = shape.asShapeNode();
  if (node == nullptr)
    return -1.0;
  const auto body = node->getBodyNodePtr();
  std::size_t part = 0;
  while (part < body->getNumShapeNodes() && body->getShapeNode(part) != node)
    ++part;
  return place(body.get(), 2 + part);
}

ContactMemory::Entry ContactMemory::entry(const ConstraintBase& constraint, const Rows& rows) const
{
  Entry entry;
  if (const auto* contact = engine::contact(constraint)) {
    const auto& shape = *contact->collisionObject1->getShapeFrame();
    entry.a = shape_place(shape);
    entry.b = shape_place(*contact->collisionObject2->getShapeFrame());
    entry.point = shape.getWorldTransform().inverse() * contact->point;
    const auto size = [](const dart::collision::CollisionObject& object) {
      return object.getShape()->getBoundingBox().computeFullExtents().norm();
    };
    entry.reach = part_of_size * std::min(size(*contact->collisionObject1), size(*contact->collisionObject2));
  } else if (rows.kind == Rows::Kind::joint) {
    entry.a = place(rows.joint.joint->getChildBodyNode(), joint_part);
    for (std::size_t i = 0; i < rows.joint.active.size(); ++i) // another set of rows is another constraint
      entry.b -= rows.joint.active[i] ? std::ldexp(1.0, static_cast<int>(i)) : 0.0;
  } else {
    entry.a = place(rows.bodies.bodies[0], pair_part);
    entry.b = place(rows.bodies.bodies[1], pair_part);
  }
  return entry;
}

void ContactMemory::recall(const ConstraintBase& constraint, const Rows& rows, Impulses impulses)
{
  impulses.setZero();
  const auto wanted = entry(constraint, rows);
  const auto less = [](const Entry& x, const Entry& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); };
  const auto range = std::equal_range(before_.begin(), before_.end(), wanted, less);
  Entry* nearest = nullptr;
  double least = wanted.reach;
  for (auto known = range.first; known != range.second; ++known)
    if (const double far = (known->point - wanted.point).norm(); !known->used && far <= least) {
      if (nearest != nullptr && far == least)
        continue;
      nearest = &*known;
      least = far;
    }
  if (nearest == nullptr)
    return;
  nearest->used = true;
  if (engine::contact(constraint) != nullptr)
    impulses = directions(rows).transpose() * nearest->impulses.head<3>();
  else
    impulses = nearest->impulses.head(impulses.size());
}

void ContactMemory::remember(const ConstraintBase& constraint, const Rows& rows, const Impulses& impulses)
{
  auto known = entry(constraint, rows);
  if (engine::contact(constraint) != nullptr)
    known.impulses.head<3>() = directions(rows) * impulses;
  else
    known.impulses.head(impulses.size()) = impulses;
  now_.push_back(known);
}

std::vector<double> ContactMemory::numbers() const
{
  std::vector<double> out;
  out.reserve(now_.size() * numbers_per_entry);
  for (const auto& entry : now_) {
    out.insert(out.end(), {entry.a, entry.b});
    out.insert(out.end(), entry.point.data(), entry.point.data() + 3);
    out.insert(out.end(), entry.impulses.data(), entry.impulses.data() + 6);
    out.push_back(entry.reach);
  }
  return out;
}

bool ContactMemory::restore(const std::vector<double>& numbers)
{
  if (numbers.size() % numbers_per_entry != 0)
    return false;
  now_.assign(numbers.size() / numbers_per_entry, Entry());
  const double* in = numbers.data();
  for (auto& entry : now_) {
    entry.a = in[0];
    entry.b = in[1];
    entry.point = Eigen::Map<const Eigen::Vector3d>(in + 2);
    entry.impulses = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(in + 5);
    entry.reach = in[11];
    in += numbers_per_entry;
  }
  return true;
}

} // namespace pydart2
