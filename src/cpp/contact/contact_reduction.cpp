#include "contact/contact_reduction.hpp"

#include <algorithm>
#include <array>
#include <dart/collision/Contact.hpp>
#include <limits>
#include <map>
#include <vector>

#include "engine/engine_access.hpp"

namespace pydart2 {

namespace {

using dart::constraint::ConstrainedGroup;
using dart::constraint::ConstraintBasePtr;

constexpr double same_normal = 0.99; // cosine of 8 degrees

/// A contact, and its number among those that are looked at.
struct Point
{
  std::size_t number;
  const dart::collision::Contact* contact;
};

struct FacePair
{
  Eigen::Vector3d normal;
  std::vector<Point> points;
};

/// Contacts by the two bodies that touch, and these by normals.
class FacePairs
{
public:
  using Bodies = std::array<dart::dynamics::BodyNode*, 2>;

  void add(std::size_t number, const Bodies& bodies, const dart::collision::Contact& contact)
  {
    auto& known = of_bodies_[bodies];
    const auto same = [&](std::size_t pair) { return pairs[pair].normal.dot(contact.normal) > same_normal; };
    auto pair = std::find_if(known.begin(), known.end(), same);
    if (pair == known.end()) {
      pair = known.insert(pair, pairs.size());
      pairs.push_back({contact.normal, {}});
    }
    pairs[*pair].points.push_back({number, &contact});
  }

  /// Calls `tell(number, depth)` with the largest depth to be believed of each.
  template <class Tell>
  void each_depth(const Tell& tell) const;

  /// The numbers of those that the others make up for.
  std::vector<std::size_t> spare() const;

  std::vector<FacePair> pairs;

private:
  std::map<Bodies, std::vector<std::size_t>> of_bodies_; // looked up only
};

/// Index of the point with the largest value.
template <class Value>
std::size_t largest(const std::vector<Point>& points, const Value& value)
{
  const auto less = [&](const Point& a, const Point& b) { return value(a.contact->point) < value(b.contact->point); };
  return static_cast<std::size_t>(std::max_element(points.begin(), points.end(), less) - points.begin());
}

/// Two points far from each other, and on each side of the line through them the one farthest from it.
std::array<std::size_t, 4> extremal(const FacePair& pair)
{
  const auto& points = pair.points;
  const Eigen::Vector3d somewhere = points.front().contact->point;
  const auto a = largest(points, [&](const Eigen::Vector3d& p) { return (p - somewhere).squaredNorm(); });
  const Eigen::Vector3d from = points[a].contact->point;
  const auto b = largest(points, [&](const Eigen::Vector3d& p) { return (p - from).squaredNorm(); });
  const Eigen::Vector3d across = pair.normal.cross(points[b].contact->point - from);
  const auto c = largest(points, [&](const Eigen::Vector3d& p) { return across.dot(p - from); });
  const auto d = largest(points, [&](const Eigen::Vector3d& p) { return -across.dot(p - from); });
  return {a, b, c, d};
}

template <class Tell>
void FacePairs::each_depth(const Tell& tell) const
{
  const auto depth = [](const FacePair& pair) {
    double most = 0.0;
    for (const auto& point : pair.points)
      most = std::max(most, point.contact->penetrationDepth);
    return most;
  };
  for (const auto& [bodies, known] : of_bodies_) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto pair : known)
      least = std::min(least, depth(pairs[pair]));
    for (const auto pair : known)
      for (const auto& point : pairs[pair].points)
        tell(point.number, std::min(point.contact->penetrationDepth, 2.0 * least));
  }
}

std::vector<std::size_t> FacePairs::spare() const
{
  std::vector<std::size_t> out;
  for (const auto& pair : pairs) {
    if (pair.points.size() <= 4)
      continue;
    const auto kept = extremal(pair);
    for (std::size_t i = 0; i < pair.points.size(); ++i)
      if (std::find(kept.begin(), kept.end(), i) == kept.end())
        out.push_back(pair.points[i].number);
  }
  return out;
}

} // namespace

namespace {

/// Lets those contacts of two shapes that stay slip as much as all would have.
void share_slip(ConstrainedGroup& group, const std::vector<ConstraintBasePtr>& spare)
{
  using Shapes = std::pair<dart::collision::CollisionObject*, dart::collision::CollisionObject*>;
  std::map<Shapes, std::array<double, 2>> counts; // all, and those that go
  const auto of = [&](const dart::collision::Contact& contact) -> auto& {
    return counts[{contact.collisionObject1, contact.collisionObject2}];
  };
  for (std::size_t i = 0; i < group.getNumConstraints(); ++i)
    if (const auto* contact = engine::contact(*group.getConstraint(i)))
      ++of(*contact)[0];
  for (const auto& constraint : spare)
    ++of(*engine::contact(*constraint))[1];
  for (std::size_t i = 0; i < group.getNumConstraints(); ++i) {
    const auto constraint = group.getConstraint(i);
    if (const auto* contact = engine::contact(*constraint)) {
      const auto [all, gone] = of(*contact);
      engine::scale_slip(*constraint, (all - gone) / all);
    }
  }
}

} // namespace

void keep_extremal_contacts(ConstrainedGroup& group)
{
  FacePairs pairs;
  for (std::size_t i = 0; i < group.getNumConstraints(); ++i) {
    const auto constraint = group.getConstraint(i);
    const auto* contact = engine::contact(*constraint);
    if (contact == nullptr)
      continue;
    engine::Rows rows;
    engine::read_rows(*constraint, rows);
    pairs.add(i, rows.bodies.bodies, *contact);
  }
  std::vector<ConstraintBasePtr> spare;
  for (const auto number : pairs.spare())
    spare.push_back(group.getConstraint(number));
  if (!spare.empty())
    share_slip(group, spare);
  for (const auto& constraint : spare)
    group.removeConstraint(constraint);
}

namespace {

FacePairs face_pairs(const std::vector<ContactTerms>& contacts)
{
  FacePairs pairs;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    pairs.add(i, contacts[i].bodies, *contacts[i].contact);
  return pairs;
}

} // namespace

void doubt_depths(std::vector<ContactTerms>& contacts)
{
  face_pairs(contacts).each_depth([&](std::size_t number, double depth) { contacts[number].depth = depth; });
}

void keep_extremal_contacts(std::vector<ContactTerms>& contacts)
{
  const FacePairs pairs = face_pairs(contacts);
  std::vector<bool> spare(contacts.size(), false);
  for (const auto number : pairs.spare())
    spare[number] = true;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (!spare[i])
      contacts[kept++] = contacts[i];
  contacts.resize(kept);
}

} // namespace pydart2
