#include "collision/completed_detectors.hpp"

#include <algorithm>

namespace pydart2 {

namespace {

bool is_any(ShapeKind kind, std::initializer_list<ShapeKind> kinds)
{
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

bool bullet_does(ShapeKind a, ShapeKind b)
{
  using K = ShapeKind;
  if (a == K::pyramid || b == K::pyramid)
    return false;
  const auto of_triangles = [](K kind) { return is_any(kind, {K::ellipsoid, K::mesh}); };
  const auto met_by_none = [](K kind) { return is_any(kind, {K::ellipsoid, K::mesh, K::plane}); };
  return !(of_triangles(a) && met_by_none(b)) && !(of_triangles(b) && met_by_none(a));
}

bool dart_does(ShapeKind a, ShapeKind b)
{
  using K = ShapeKind;
  const auto knows = [](K kind) { return is_any(kind, {K::box, K::sphere, K::other}); };
  return knows(a) && knows(b);
}

} // namespace

template <>
BulletDetector::CompletedDetector() : Completed(bullet_does)
{
}

template <>
DartDetector::CompletedDetector() : Completed(dart_does)
{
}

} // namespace pydart2
