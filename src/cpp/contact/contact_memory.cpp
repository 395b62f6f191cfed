#include "contact/contact_memory.hpp"

#include <algorithm>
#include <cmath>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/Contact.hpp>
#include <dart/dynamics/ShapeNode.hpp>

namespace pydart2 {

namespace {

using engine::Rows;

constexpr double part_of_size = 0.02;
constexpr std::size_t joint_part = 0, pair_part = 1; // of constraints; shapes are counted from 2

bool less(const ContactMemory::Key& x, const ContactMemory::Key& y)
{
  return x.a != y.a ? x.a < y.a : x.b < y.b;
}

} // namespace

void ContactMemory::begin_step(const std::vector<dart::dynamics::SkeletonPtr>& skeletons, bool same)
{
  before_.swap(now_);
  now_.clear();
  next_ = 0;
  for (auto& entry : before_)
    entry.used = false;
  const auto sooner = [](const Entry& x, const Entry& y) { return less(x.key, y.key); };
  if (!std::is_sorted(before_.begin(), before_.end(), sooner))
    std::stable_sort(before_.begin(), before_.end(), sooner);
  shapes_ = {};
  if (same)
    return;
  items_.clear();
  skeletons_.clear();
  order_.clear();
  for (const auto& skeleton : skeletons) {
    order_.emplace(skeleton.get(), skeletons_.size());
    skeletons_.push_back(skeleton.get());
  }
}

double ContactMemory::place(const dart::dynamics::BodyNode* body, std::size_t part) const
{
  if (body == nullptr)
    return -1.0;
  const auto found = order_.find(body->getSkeleton().get());
  const double skeleton = found == order_.end() ? -1.0 : static_cast<double>(found->second);
  constexpr double most = 65536.0; // bodies of a skeleton and parts of a body: the sum is exact in a double
  return (skeleton * most + static_cast<double>(body->getIndexInSkeleton())) * 1024.0 + static_cast<double>(part % 1024);
}

double ContactMemory::shape_place(const dart::dynamics::ShapeFrame& shape) const
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

ContactMemory::Shape ContactMemory::look(const dart::collision::CollisionObject& object) const
{
  return {&object, shape_place(*object.getShapeFrame()), object.getShape()->getBoundingBox().computeFullExtents().norm()};
}

const ContactMemory::Shape& ContactMemory::look_at(std::size_t side, const dart::collision::CollisionObject& object)
{
  auto& shape = shapes_[side];
  if (shape.object != &object)
    shape = look(object);
  return shape;
}

const ContactMemory::Shape& ContactMemory::look_at_item(int item, const dart::collision::CollisionObject& object)
{
  const auto i = static_cast<std::size_t>(item);
  if (i >= items_.size())
    items_.resize(i + 1);
  auto& shape = items_[i];
  if (shape.object != &object)
    shape = look(object);
  return shape;
}

ContactMemory::Key ContactMemory::key(const native::Touch& touch)
{
  const Shape a = look_at_item(touch.item_a, *touch.a);
  const Shape& b = look_at_item(touch.item_b, *touch.b);
  return {a.place, b.place, touch.on_a, part_of_size * std::min(a.size, b.size)};
}

ContactMemory::Key ContactMemory::key(const dart::collision::Contact& contact)
{
  const auto& a = look_at(0, *contact.collisionObject1);
  const auto& b = look_at(1, *contact.collisionObject2);
  const auto& pose = contact.collisionObject1->getShapeFrame()->getWorldTransform();
  return {
      a.place, b.place, pose.linear().transpose() * (contact.point - pose.translation()),
      part_of_size * std::min(a.size, b.size)};
}

ContactMemory::Key ContactMemory::key(const Rows& rows) const
{
  Key key;
  if (rows.kind == Rows::Kind::joint) {
    key.a = place(rows.joint.joint->getChildBodyNode(), joint_part);
    for (std::size_t i = 0; i < rows.joint.active.size(); ++i) // another set of rows is another constraint
      key.b -= rows.joint.active[i] ? std::ldexp(1.0, static_cast<int>(i)) : 0.0;
  } else {
    key.a = place(rows.bodies.bodies[0], pair_part);
    key.b = place(rows.bodies.bodies[1], pair_part);
  }
  return key;
}

/// The first entry that is not less: mostly one of the next after that of the last call.
std::vector<ContactMemory::Entry>::iterator ContactMemory::find(const Key& wanted)
{
  constexpr std::size_t near = 8;
  std::size_t i = next_;
  if (i > 0 && !less(before_[i - 1].key, wanted))
    i = before_.size();
  for (const auto end = std::min(before_.size(), i + near); i < end; ++i)
    if (!less(before_[i].key, wanted))
      return before_.begin() + static_cast<std::ptrdiff_t>(next_ = i);
  const auto sooner = [](const Entry& entry, const Key& key) { return less(entry.key, key); };
  const auto found = std::lower_bound(before_.begin(), before_.end(), wanted, sooner);
  next_ = static_cast<std::size_t>(found - before_.begin());
  return found;
}

ContactMemory::Vector6 ContactMemory::recall(const Key& wanted)
{
  auto known = find(wanted);
  Entry* nearest = nullptr;
  double least = wanted.reach;
  for (; known != before_.end() && !less(wanted, known->key); ++known)
    if (const double far = (known->key.point - wanted.point).norm(); !known->used && far <= least) {
      if (nearest != nullptr && far == least)
        continue;
      nearest = &*known;
      least = far;
    }
  if (nearest == nullptr)
    return Vector6::Zero();
  nearest->used = true;
  return nearest->impulses;
}

std::vector<double> ContactMemory::numbers() const
{
  std::vector<double> out;
  out.reserve(now_.size() * numbers_per_entry);
  for (const auto& entry : now_) {
    out.insert(out.end(), {entry.key.a, entry.key.b});
    out.insert(out.end(), entry.key.point.data(), entry.key.point.data() + 3);
    out.insert(out.end(), entry.impulses.data(), entry.impulses.data() + 6);
    out.push_back(entry.key.reach);
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
    entry.key.a = in[0];
    entry.key.b = in[1];
    entry.key.point = Eigen::Map<const Eigen::Vector3d>(in + 2);
    entry.impulses = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(in + 5);
    entry.key.reach = in[11];
    in += numbers_per_entry;
  }
  return true;
}

} // namespace pydart2
