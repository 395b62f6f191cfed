#include <cmath>

#include "collision/native_geometry.hpp"

namespace pydart2::native {

namespace {

Feature point(const Vector& at, std::uint32_t code)
{
  Feature made;
  made.add(at);
  made.code = code;
  return made;
}

Feature segment(const Vector& from, const Vector& to, std::uint32_t code)
{
  Feature made;
  made.add(from);
  made.add(to);
  made.code = code;
  return made;
}

constexpr int circle = 16; ///< Corners at most.

const std::array<std::pair<double, double>, circle>& unit_circle()
{
  static const auto corners = [] {
    std::array<std::pair<double, double>, circle> made;
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = {std::cos(2.0 * M_PI * static_cast<double>(i) / circle), std::sin(2.0 * M_PI * static_cast<double>(i) / circle)};
    return made;
  }();
  return corners;
}

/// With 4, 8 or 16 corners.
Feature disc(double radius, double z, bool up, int corners, std::uint32_t code)
{
  Feature made;
  const auto& rim = unit_circle();
  const int step = circle / corners;
  for (int i = 0; i < circle; i += step) {
    const auto& [cosine, sine] = rim[static_cast<std::size_t>(i)];
    made.add({radius * cosine, (up ? radius : -radius) * sine, z});
  }
  made.face = made.round = true;
  made.normal = Vector(0.0, 0.0, up ? 1.0 : -1.0);
  made.code = code;
  return made;
}

/// A box looks into a direction with a face if two axes are across it, with an edge if one is.
Feature of_box(const Vector& half, const Vector& n, double slack)
{
  const Eigen::Array<bool, 3, 1> across = n.array().abs() <= slack;
  const auto signs = [&](int i) { return n[i] < 0 ? -half[i] : half[i]; };
  Vector corner(signs(0), signs(1), signs(2));
  std::uint32_t code = 0;
  for (int i = 0, weight = 1; i < 3; ++i, weight *= 3)
    code += static_cast<std::uint32_t>(weight * (across[i] ? 2 : n[i] < 0 ? 0 : 1));
  if (across.count() == 0)
    return point(corner, code);
  int axis = 0;
  if (across.count() == 1) {
    while (!across[axis])
      ++axis;
    Vector other = corner;
    corner[axis] = -half[axis];
    other[axis] = half[axis];
    return segment(corner, other, code);
  }
  n.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double side = n[axis] < 0 ? -1.0 : 1.0;
  Feature made;
  const int steps[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const auto& step : steps) {
    corner[u] = half[u] * step[0] * side; // with the side: counterclockwise seen from outside
    corner[v] = half[v] * step[1];
    made.add(corner);
  }
  made.face = true;
  made.normal = Vector::Zero();
  made.normal[axis] = side;
  made.code = code;
  return made;
}

Feature of_cylinder(const Vector& half, const Vector& n, double slack, int corners)
{
  const double across = std::hypot(n.x(), n.y());
  const bool up = n.z() >= 0;
  if (across <= slack)
    return disc(half.x(), up ? half.z() : -half.z(), up, corners, up ? 1 : 2);
  const double x = half.x() * n.x() / across, y = half.x() * n.y() / across;
  if (std::abs(n.z()) <= slack)
    return segment({x, y, -half.z()}, {x, y, half.z()}, 3);
  return point({x, y, up ? half.z() : -half.z()}, up ? 4 : 5);
}

Feature of_cone(const Vector& half, const Vector& n, double slack, int corners)
{
  const double across = std::hypot(n.x(), n.y());
  if (across <= slack && n.z() < 0)
    return disc(half.x(), -half.z(), false, corners, 1);
  const Vector tip(0.0, 0.0, half.z());
  if (across <= 1e-300)
    return point(tip, 2);
  const Vector base(half.x() * n.x() / across, half.x() * n.y() / across, -half.z());
  const double slant = std::hypot(half.x(), 2.0 * half.z()); // of the side, whose normal is (2 half.z, half.x) / slant
  const double away = (n.z() * 2.0 * half.z() - across * half.x()) / slant;
  if (std::abs(away) <= slack && n.z() * half.x() + across * 2.0 * half.z() > 0)
    return segment(base, tip, 3);
  return away > 0 ? point(tip, 2) : point(base, 4);
}

Feature of_hull(const Hull& hull, const Vector& n, double slack)
{
  std::size_t best = 0;
  for (std::size_t i = 1; i < hull.normals.size(); ++i)
    if (hull.normals[i].dot(n) > hull.normals[best].dot(n))
      best = i;
  const auto& face = hull.faces[best];
  Feature made;
  made.code = static_cast<std::uint32_t>(best);
  if (hull.normals[best].cross(n).norm() <= slack) {
    const std::size_t step = (face.size() + Feature::most - 1) / Feature::most;
    for (std::size_t i = 0; i < face.size(); i += step)
      made.add(hull.corners[static_cast<std::size_t>(face[i])]);
    made.face = true;
    made.normal = hull.normals[best];
    return made;
  }
  std::size_t top = 0; // the corner farthest along n, then the longest edge of the face that is across it
  const auto at = [&](std::size_t i) -> const Vector& { return hull.corners[static_cast<std::size_t>(face[i % face.size()])]; };
  for (std::size_t i = 1; i < face.size(); ++i)
    if (at(i).dot(n) > at(top).dot(n))
      top = i;
  const std::uint32_t code = static_cast<std::uint32_t>(face[top]) + 1;
  for (const std::size_t other : {top + 1, top + face.size() - 1}) {
    const Vector edge = at(other) - at(top);
    if (std::abs(edge.dot(n)) <= slack * edge.norm())
      return segment(at(top), at(other), code * 3 + (other == top + 1 ? 1 : 2));
  }
  return point(at(top), code * 3);
}

Feature of_triangle(const Geometry& shape, const Vector& n, double slack)
{
  const auto& corners = shape.triangle;
  const bool front = shape.normal.dot(n) >= 0;
  Feature made;
  if (shape.normal.cross(n).norm() <= slack) {
    for (const int i : {0, front ? 1 : 2, front ? 2 : 1})
      made.add(corners[static_cast<std::size_t>(i)]);
    made.face = true;
    made.normal = front ? shape.normal : Vector(-shape.normal);
    made.code = front ? 1 : 2;
    return made;
  }
  std::size_t top = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (corners[i].dot(n) > corners[top].dot(n))
      top = i;
  for (const std::size_t step : {1, 2}) {
    const auto& other = corners[(top + step) % 3];
    const Vector edge = other - corners[top];
    if (std::abs(edge.dot(n)) <= slack * edge.norm())
      return segment(corners[top], other, static_cast<std::uint32_t>(3 + top + (top + step) % 3));
  }
  return point(corners[top], static_cast<std::uint32_t>(7 + top));
}

} // namespace

void Feature::move(const Pose& pose)
{
  for (int i = 0; i < count; ++i)
    at[static_cast<std::size_t>(i)] = pose * at[static_cast<std::size_t>(i)];
  normal = pose.linear() * normal;
}

Feature feature_of(const Geometry& shape, const Vector& n, double slack, int corners)
{
  const Vector& half = shape.half;
  switch (shape.form) {
  case Form::capsule:
    if (std::abs(n.z()) <= slack)
      return segment({0.0, 0.0, -half.z()}, {0.0, 0.0, half.z()}, 1);
    return point({0.0, 0.0, n.z() < 0 ? -half.z() : half.z()}, n.z() < 0 ? 2 : 3);
  case Form::box:
    return of_box(half, n, slack);
  case Form::cylinder:
    return of_cylinder(half, n, slack, corners);
  case Form::cone:
    return of_cone(half, n, slack, corners);
  case Form::hull:
    return of_hull(*shape.hull, n, slack);
  case Form::triangle:
    return of_triangle(shape, n, slack);
  default:
    return point(support(shape, n), 0);
  }
}

} // namespace pydart2::native
