#include "collision/engine_detectors.hpp"

namespace pydart2 {

namespace {

using K = ShapeKind;

/// Ellipsoids and meshes are triangles, which meet only what is solid.
bool bullet_does(ShapeKind a, ShapeKind b)
{
  const auto of_triangles = [](K kind) { return kind == K::ellipsoid || kind == K::mesh; };
  const auto solid = [&](K kind) { return !of_triangles(kind) && kind != K::plane; };
  return a != K::pyramid && b != K::pyramid && (!of_triangles(a) || solid(b)) && (!of_triangles(b) || solid(a));
}

bool dart_does(ShapeKind a, ShapeKind b)
{
  const auto knows = [](K kind) { return kind == K::box || kind == K::sphere || kind == K::other; };
  return knows(a) && knows(b);
}

} // namespace

BulletDetector::BulletDetector() : CompletedDetector(bullet_does) {}

std::shared_ptr<BulletDetector> BulletDetector::create()
{
  return std::shared_ptr<BulletDetector>(new BulletDetector());
}

DartDetector::DartDetector() : CompletedDetector(dart_does) {}

std::shared_ptr<DartDetector> DartDetector::create()
{
  return std::shared_ptr<DartDetector>(new DartDetector());
}

} // namespace pydart2
