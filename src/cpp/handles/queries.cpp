#include "handles/queries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "state/contact.hpp"

namespace pydart2 {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

native::Ray ray_of(const double* origin, const double* direction)
{
  const Eigen::Map<const Eigen::Vector3d> along(direction);
  check::direction(along, "the direction of a ray");
  return {Eigen::Map<const Eigen::Vector3d>(origin), along.stableNormalized()};
}

void check_points(const MatrixIn& points, const char* what)
{
  check::shape(points, static_cast<std::size_t>(points.rows), 3, what);
  check::finite(VectorIn{points.data, 3 * points.rows}, what);
}

void check_most(double max_distance)
{
  if (!(max_distance >= 0.0))
    throw Error(Kind::value, "the longest distance of a query is >= 0, got " + std::to_string(max_distance));
}

std::set<std::pair<int, int>> rows_of(const MatrixIn& bodies)
{
  check::shape(bodies, static_cast<std::size_t>(bodies.rows), 2, "bodies");
  std::set<std::pair<int, int>> found;
  for (long i = 0; i < bodies.rows; ++i)
    found.emplace(static_cast<int>(bodies.data[2 * i]), static_cast<int>(bodies.data[2 * i + 1]));
  return found;
}

} // namespace

QueriesHandle::QueriesHandle(const WorldHandle& world) : world_(world.ref()) {}

void QueriesHandle::look(const MatrixIn* ignore)
{
  world_->check();
  const auto left_out = ignore == nullptr ? std::set<std::pair<int, int>>() : rows_of(*ignore);
  std::vector<const dart::dynamics::ShapeNode*> shapes;
  places_.clear();
  for (std::size_t s = 0; s < world_->skeletons.size(); ++s) {
    const auto& skeleton = *world_->skeletons[s]->skeleton;
    for (std::size_t b = 0; b < skeleton.getNumBodyNodes(); ++b) {
      if (left_out.count({static_cast<int>(s), static_cast<int>(b)}) != 0)
        continue;
      const auto* body = skeleton.getBodyNode(b);
      for (std::size_t i = 0; i < body->getNumShapeNodes(); ++i)
        if (const auto* node = body->getShapeNode(i); node->getCollisionAspect() != nullptr && node->getShape() != nullptr) {
          shapes.push_back(node);
          places_.push_back({static_cast<int>(s), static_cast<int>(b), static_cast<int>(i), body});
        }
    }
  }
  scene_.set(shapes);
}

void QueriesHandle::raycast(
    const MatrixIn& origins, const MatrixIn& directions, double max_distance, const MatrixIn& ignore, Output& out)
{
  check_points(origins, "the origins");
  check::shape(directions, static_cast<std::size_t>(origins.rows), 3, "the directions");
  check_most(max_distance);
  std::vector<native::Ray> cast;
  for (long i = 0; i < origins.rows; ++i)
    cast.push_back(ray_of(origins.data + 3 * i, directions.data + 3 * i));
  look(&ignore);
  auto rows = matrix(out, origins.rows, 10);
  for (long i = 0; i < origins.rows; ++i) {
    const auto& ray = cast[static_cast<std::size_t>(i)];
    native::RayHit hit;
    hit.distance = std::nextafter(max_distance, infinity);
    const int which = scene_.cast(ray, hit);
    if (which < 0) {
      rows.row(i) << infinity, Eigen::RowVectorXd::Constant(6, std::nan("")), -1.0, -1.0, -1.0;
      continue;
    }
    const auto& place = places_[static_cast<std::size_t>(which)];
    rows.row(i) << hit.distance, ray.at(hit.distance).transpose(), hit.normal.transpose(), double(place.skeleton),
        double(place.body), double(place.shape);
  }
}

void QueriesHandle::nearest(const MatrixIn& points, double max_distance, const MatrixIn& ignore, Output& out)
{
  check_points(points, "the points");
  check_most(max_distance);
  look(&ignore);
  auto rows = matrix(out, points.rows, 10);
  for (long i = 0; i < points.rows; ++i) {
    native::Clearance found;
    found.distance = max_distance;
    const int which = scene_.nearest(Eigen::Map<const Eigen::Vector3d>(points.data + 3 * i), found);
    if (which < 0) {
      rows.row(i) << infinity, Eigen::RowVectorXd::Constant(6, std::nan("")), -1.0, -1.0, -1.0;
      continue;
    }
    const auto& place = places_[static_cast<std::size_t>(which)];
    rows.row(i) << found.distance, found.on_a.transpose(), -found.normal.transpose(), double(place.skeleton),
        double(place.body), double(place.shape);
  }
}

std::vector<int> QueriesHandle::shapes_of(const MatrixIn& bodies) const
{
  const auto wanted = rows_of(bodies);
  std::vector<int> found;
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (wanted.count({places_[i].skeleton, places_[i].body}) != 0)
      found.push_back(static_cast<int>(i));
  return found;
}

std::vector<std::pair<double, QueriesHandle::Pair>> QueriesHandle::pairs(const MatrixIn& a, const MatrixIn& b) const
{
  std::vector<std::pair<double, Pair>> found;
  std::set<Pair> seen;
  const auto of_b = shapes_of(b);
  for (const int i : shapes_of(a))
    for (const int j : of_b) {
      const auto *one = places_[static_cast<std::size_t>(i)].node, *other = places_[static_cast<std::size_t>(j)].node;
      const bool joined = one->getParentBodyNode() == other || other->getParentBodyNode() == one;
      const double least = scene_.least_distance(i, j);
      if (one == other || joined || least == infinity || passes_through(*world_, *one, *other))
        continue;
      if (seen.emplace(std::min(i, j), std::max(i, j)).second)
        found.push_back({least, {i, j}});
    }
  std::sort(found.begin(), found.end());
  return found;
}

void QueriesHandle::distances(const MatrixIn& a, const MatrixIn& b, double max_distance, bool only_least, Output& out)
{
  check_most(max_distance);
  look(nullptr);
  std::vector<std::pair<native::Clearance, Pair>> found;
  double most = max_distance;
  for (const auto& [least, pair] : pairs(a, b)) {
    if (least > most)
      break;
    native::Clearance clearance;
    if (!scene_.clearance(pair.first, pair.second, most, clearance))
      continue;
    if (only_least && !found.empty()) {
      if (clearance.distance >= found.front().first.distance)
        continue;
      found.clear();
    }
    found.emplace_back(clearance, pair);
    if (only_least)
      most = clearance.distance;
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& one, const auto& other) {
    return one.first.distance < other.first.distance;
  });
  auto rows = matrix(out, static_cast<long>(found.size()), 16);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [clearance, pair] = found[i];
    const auto &one = places_[static_cast<std::size_t>(pair.first)], &other = places_[static_cast<std::size_t>(pair.second)];
    rows.row(static_cast<long>(i)) << clearance.distance, clearance.on_a.transpose(), clearance.on_b.transpose(),
        clearance.normal.transpose(), double(one.skeleton), double(one.body), double(one.shape), double(other.skeleton),
        double(other.body), double(other.shape);
  }
}

void QueriesHandle::contacts(const MatrixIn& a, const MatrixIn& b, Output& out)
{
  look(nullptr);
  std::vector<std::pair<native::Point, Pair>> found;
  native::Points points;
  for (const auto& [least, pair] : pairs(a, b)) {
    if (least > 0.0)
      break;
    points.clear();
    scene_.collide(pair.first, pair.second, points);
    for (const auto& point : points)
      found.emplace_back(point, pair);
  }
  auto rows = matrix(out, static_cast<long>(found.size()), contact_columns);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [point, pair] = found[i];
    const auto &one = places_[static_cast<std::size_t>(pair.first)], &other = places_[static_cast<std::size_t>(pair.second)];
    rows.row(static_cast<long>(i)) << point.at.transpose(), 0.0, 0.0, 0.0, double(one.skeleton), double(one.body),
        double(other.skeleton), double(other.body), double(one.shape), double(other.shape), point.normal.transpose(),
        point.depth;
  }
}

} // namespace pydart2
