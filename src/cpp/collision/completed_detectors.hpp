#pragma once

#include <dart/collision/bullet/BulletCollisionDetector.hpp>
#include <dart/collision/dart/DARTCollisionDetector.hpp>

#include "collision/missing_pairs.hpp"

namespace pydart2 {

/// One of the engine's detectors with the contacts of the pairs that it misses.
template <class Engine>
class CompletedDetector final : public Engine, public Completed
{
public:
  static std::shared_ptr<CompletedDetector> create()
  {
    return std::shared_ptr<CompletedDetector>(new CompletedDetector());
  }

  std::shared_ptr<dart::collision::CollisionDetector> cloneWithoutCollisionObjects() const override
  {
    const auto made = create();
    made->missing.engine_shapes = missing.engine_shapes;
    return made;
  }

  using Engine::collide;
  bool collide(
      dart::collision::CollisionGroup* group, const dart::collision::CollisionOption& option,
      dart::collision::CollisionResult* result) override
  {
    return missing.collide(
        *this, *group, option, result, [&](const dart::collision::CollisionOption& part) {
          return Engine::collide(group, part, result);
        });
  }

private:
  CompletedDetector();
};

using BulletDetector = CompletedDetector<dart::collision::BulletCollisionDetector>;
using DartDetector = CompletedDetector<dart::collision::DARTCollisionDetector>;

} // namespace pydart2
