#pragma once

#include <dart/collision/bullet/BulletCollisionDetector.hpp>
#include <dart/collision/dart/DARTCollisionDetector.hpp>

#include "collision/completed_detector.hpp"

namespace pydart2 {

/// The engine's detector with Bullet, completed. Height fields stay as they are: the engine's turns the heights of the shape
/// itself round whenever it meets the shape, so that every second detector has the mirror image.
class BulletDetector final : public CompletedDetector<dart::collision::BulletCollisionDetector>
{
public:
  static std::shared_ptr<BulletDetector> create();
  std::shared_ptr<dart::collision::CollisionDetector> cloneWithoutCollisionObjects() const override { return create(); }

protected:
  std::unique_ptr<dart::collision::CollisionObject> createCollisionObject(const dart::dynamics::ShapeFrame* frame) override;

private:
  BulletDetector();
};

/// The engine's own detector, completed.
class DartDetector final : public CompletedDetector<dart::collision::DARTCollisionDetector>
{
public:
  static std::shared_ptr<DartDetector> create();
  std::shared_ptr<dart::collision::CollisionDetector> cloneWithoutCollisionObjects() const override { return create(); }

private:
  DartDetector();
};

} // namespace pydart2
