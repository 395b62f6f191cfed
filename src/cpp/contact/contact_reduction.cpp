#include "contact/contact_reduction.hpp"

#include <algorithm>
#include <array>
#include <dart/collision/Contact.hpp>
#include <map>
#include <vector>

#include "engine/engine_access.hpp"

namespace pydart2 {

namespace {

using dart::constraint::ConstrainedGroup;
using dart::constraint::ConstraintBasePtr;

constexpr double same_normal = 0.99; // cosine of 8 degrees

struct Point
{
  ConstraintBasePtr constraint;
  const dart::collision::Contact* contact;
};

struct FacePair
{
  std::array<dart::dynamics::BodyNode*, 2> bodies;
  Eigen::Vector3d normal;
  std::vector<Point> points;
};

std::vector<FacePair> face_pairs(ConstrainedGroup& group)
{
  std::vector<FacePair> pairs;
  std::map<std::array<dart::dynamics::BodyNode*, 2>, std::vector<std::size_t>> of_bodies; // looked up only
  for (std::size_t i = 0; i < group.getNumConstraints(); ++i) {
    const auto constraint = group.getConstraint(i);
    const auto* contact = engine::contact(*constraint);
    if (contact == nullptr)
      continue;
    engine::Rows rows;
    engine::read_rows(*constraint, rows);
    auto& known = of_bodies[rows.bodies.bodies];
    const auto same = [&](std::size_t pair) { return pairs[pair].normal.dot(contact->normal) > same_normal; };
    auto pair = std::find_if(known.begin(), known.end(), same);
    if (pair == known.end()) {
      pair = known.insert(pair, pairs.size());
      pairs.push_back({rows.bodies.bodies, contact->normal, {}});
    }
    pairs[*pair].points.push_back({constraint, contact});
  }
  return pairs;
}

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

} // namespace

void keep_extremal_contacts(ConstrainedGroup& group)
{
  for (const auto& pair : face_pairs(group)) {
    if (pair.points.size() <= 4)
      continue;
    const auto kept = extremal(pair);
    for (std::size_t i = 0; i < pair.points.size(); ++i)
      if (std::find(kept.begin(), kept.end(), i) == kept.end())
        group.removeConstraint(pair.points[i].constraint);
  }
}

} // namespace pydart2
