#pragma once

#include "collision/detector.hpp"
#include "collision/missing_pairs.hpp"

namespace pydart2 {

/// One of the engine's detectors with the contacts of the pairs that it misses.
template <class Engine>
class CompletedDetector : public Engine, public ShapeChoice
{
public:
  using Engine::collide;
  bool collide(
      dart::collision::CollisionGroup* group, const dart::collision::CollisionOption& option,
      dart::collision::CollisionResult* result) override
  {
    if (option.maxNumContacts == 0)
      return Engine::collide(group, option, result); // nothing is looked for
    const auto engine = [&](const dart::collision::CollisionOption& part) {
      return Engine::collide(group, part, result);
    };
    return engine_shapes ? engine(option) : missing_.collide(*this, *group, option, result, engine);
  }

  std::unique_ptr<dart::collision::CollisionGroup> createCollisionGroup() override
  {
    missing_.forget(); // it may be where one was
    return Engine::createCollisionGroup();
  }

protected:
  explicit CompletedDetector(MissingPairs::Does does) : missing_(does) {}

  // Shapes that come, change and go. Who does not call these says forget().
  std::unique_ptr<dart::collision::CollisionObject> createCollisionObject(const dart::dynamics::ShapeFrame* frame) override
  {
    missing_.forget();
    return Engine::createCollisionObject(frame);
  }
  void refreshCollisionObject(dart::collision::CollisionObject* object) override
  {
    missing_.forget();
    Engine::refreshCollisionObject(object);
  }
  void notifyCollisionObjectDestroying(dart::collision::CollisionObject* object) override
  {
    missing_.forget();
    Engine::notifyCollisionObjectDestroying(object);
  }
  void forget() { missing_.forget(); }

private:
  MissingPairs missing_;
};

} // namespace pydart2
