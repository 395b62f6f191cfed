#include "collision/engine_detectors.hpp"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <dart/collision/bullet/BulletCollisionObject.hpp>
#include <dart/dynamics/HeightmapShape.hpp>
#include <dart/dynamics/ShapeFrame.hpp>
#include <memory>

namespace pydart2 {

using dart::collision::BulletCollisionObject;
using dart::collision::BulletCollisionShape;
using dart::dynamics::HeightmapShapef;

namespace {

/// Bullet's shape, which points to heights, and these, with Bullet's first row at the least y.
struct Terrain : BulletCollisionShape
{
  using Heights = HeightmapShapef::HeightField;

  explicit Terrain(const HeightmapShapef& shape) : Terrain(shape, std::make_unique<Heights>(shape.getHeightField().colwise().reverse()))
  {
  }

private:
  Terrain(const HeightmapShapef& shape, std::unique_ptr<Heights> heights)
    : BulletCollisionShape(field(shape, *heights), middle(shape)), heights_(std::move(heights))
  {
  }

  static std::unique_ptr<btCollisionShape> field(const HeightmapShapef& shape, const Heights& heights)
  {
    constexpr int z = 2;
    auto made = std::make_unique<btHeightfieldTerrainShape>(
        static_cast<int>(shape.getWidth()), static_cast<int>(shape.getDepth()), heights.data(), 1.0F, shape.getMinHeight(),
        shape.getMaxHeight(), z, PHY_FLOAT, false);
    const auto& scale = shape.getScale();
    made->setLocalScaling({scale.x(), scale.y(), scale.z()});
    made->setUseZigzagSubdivision(true);
    return made;
  }

  /// Bullet's origin is in the middle of the heights.
  static btTransform middle(const HeightmapShapef& shape)
  {
    const float height = (shape.getMaxHeight() + shape.getMinHeight()) * 0.5F * shape.getScale().z();
    return btTransform(btMatrix3x3::getIdentity(), {0.0F, 0.0F, height});
  }

  std::unique_ptr<Heights> heights_;
};

struct TerrainObject : BulletCollisionObject
{
  TerrainObject(
      dart::collision::CollisionDetector* detector, const dart::dynamics::ShapeFrame* frame,
      const std::shared_ptr<BulletCollisionShape>& terrain)
    : BulletCollisionObject(detector, frame, terrain)
  {
  }
};

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

std::unique_ptr<dart::collision::CollisionObject> BulletDetector::createCollisionObject(const dart::dynamics::ShapeFrame* frame)
{
  if (const auto* heights = dynamic_cast<const HeightmapShapef*>(frame->getShape().get())) {
    forget();
    return std::make_unique<TerrainObject>(this, frame, std::make_shared<Terrain>(*heights));
  }
  return CompletedDetector::createCollisionObject(frame);
}

DartDetector::DartDetector() : CompletedDetector(dart_does) {}

std::shared_ptr<DartDetector> DartDetector::create()
{
  return std::shared_ptr<DartDetector>(new DartDetector());
}

} // namespace pydart2
