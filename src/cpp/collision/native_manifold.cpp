#include "collision/native_manifold.hpp"

#include <algorithm>
#include <array>

namespace pydart2::native {

namespace {

/// A corner while a polygon is cut: the edge that begins there, and a number by which the corner is known.
struct Cut
{
  Vector at;
  std::uint32_t edge, key;
};

/// Of an edge: corners so little beyond it stay where they are. Where edges lie on each other, their crossing would run
/// along them with the least motion.
constexpr double slack = 1e-4;
constexpr std::size_t room = 2 * Feature::most + 2;

struct Outline
{
  std::size_t count = 0;
  std::array<Cut, room> cuts;

  void add(const Cut& cut)
  {
    if (count < room)
      cuts[count++] = cut;
  }
};

/// Cuts off what lies outside a plane through `through` with the outward normal `out`, the `plane`-th one.
void cut(const Outline& from, const Vector& through, const Vector& out, std::uint32_t plane, bool closed, Outline& into)
{
  into.count = 0;
  const double most = slack * out.squaredNorm();
  for (std::size_t i = 0; i < from.count; ++i) {
    const Cut& here = from.cuts[i];
    const double outside = out.dot(here.at - through);
    if (outside <= most)
      into.add(here);
    if (i + 1 == from.count && !closed)
      break;
    const Cut& next = from.cuts[(i + 1) % from.count];
    const double next_outside = out.dot(next.at - through);
    if ((outside <= most) == (next_outside <= most) || std::min(outside, next_outside) > 0)
      continue;
    const Vector at = here.at + (outside / (outside - next_outside)) * (next.at - here.at);
    const std::uint32_t key = 64 * (plane + 1) + here.edge;
    into.add({at, outside <= 0 ? 32 + plane : here.edge, key});
  }
}

std::uint32_t feature_number(const Feature& polygon, const Feature& other, double sign, std::uint32_t key)
{
  return (sign > 0 ? 1U << 31 : 0U) | (polygon.code & 0x1ffU) << 22 | (other.code & 0x3ffU) << 12 | (key & 0xfffU);
}

} // namespace

void add_clipped(
    const Feature& polygon, double polygon_radius, const Feature& other, double other_radius, double sign, double margin,
    Points& points)
{
  Outline one, two;
  for (int i = 0; i < other.count; ++i)
    one.add({other[i], static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i)});
  Outline *now = &one, *next = &two;
  for (int i = 0; i < polygon.count && now->count > 0; ++i) {
    const Vector out = (polygon[(i + 1) % polygon.count] - polygon[i]).cross(polygon.normal);
    cut(*now, polygon[i], out, static_cast<std::uint32_t>(i), other.face, *next);
    std::swap(now, next);
  }
  const Vector& normal = polygon.normal;
  const double offset = normal.dot(polygon[0]) + polygon_radius + other_radius;
  for (std::size_t i = 0; i < now->count; ++i) {
    const Cut& corner = now->cuts[i];
    const double depth = offset - normal.dot(corner.at);
    if (depth >= -margin)
      points.push_back(
          {corner.at + normal * (depth / 2.0 - other_radius), sign * normal, depth,
           feature_number(polygon, other, sign, corner.key)});
  }
}

void add_below(
    const Vector& normal, double offset, const Feature& other, double radius, double sign, double margin, Points& points)
{
  const Feature plane;
  for (int i = 0; i < other.count; ++i) {
    const double depth = offset + radius - normal.dot(other[i]);
    if (depth >= -margin)
      points.push_back(
          {other[i] + normal * (depth / 2.0 - radius), sign * normal, depth,
           feature_number(plane, other, sign, static_cast<std::uint32_t>(i))});
  }
}

bool holds(const Feature& polygon, const Vector& point, double slack)
{
  for (int i = 0; i < polygon.count; ++i) {
    const Vector edge = polygon[(i + 1) % polygon.count] - polygon[i];
    if (edge.cross(polygon.normal).dot(point - polygon[i]) > slack * edge.norm())
      return false;
  }
  return polygon.count > 2;
}

void keep_four(Points& points, std::size_t begin, double size)
{
  if (points.size() - begin <= 4)
    return;
  const auto at = [&](std::size_t i) -> const Vector& { return points[i].at; };
  // The first of those that are equal but for rounding, so that a body at rest keeps its points.
  const auto largest = [&](const auto& value, double tie) {
    std::size_t best = begin;
    double most = value(begin);
    for (std::size_t i = begin + 1; i < points.size(); ++i)
      if (const double v = value(i); v > most + tie) {
        most = v;
        best = i;
      }
    return best;
  };
  const auto a = largest([&](std::size_t i) { return points[i].depth; }, 1e-6 * size);
  const auto b = largest([&](std::size_t i) { return (at(i) - at(a)).squaredNorm(); }, 1e-6 * size * size);
  const Vector across = points[a].normal.cross(at(b) - at(a));
  const double tie = 1e-6 * size * across.norm();
  const auto c = largest([&](std::size_t i) { return across.dot(at(i) - at(a)); }, tie);
  const auto d = largest([&](std::size_t i) { return -across.dot(at(i) - at(a)); }, tie);
  std::array<std::size_t, 4> kept{a, b, c, d};
  std::sort(kept.begin(), kept.end());
  const auto end = std::unique(kept.begin(), kept.end());
  std::size_t count = begin;
  for (auto it = kept.begin(); it != end; ++it)
    points[count++] = points[*it];
  points.resize(count);
}

} // namespace pydart2::native
