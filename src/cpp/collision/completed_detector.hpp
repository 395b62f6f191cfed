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
    const auto engine = [&](const dart::collision::CollisionOption& part) {
      return Engine::collide(group, part, result);
    };
    return engine_shapes ? engine(option) : missing_.collide(*this, *group, option, result, engine);
  }

protected:
  explicit CompletedDetector(MissingPairs::Does does) : missing_(does) {}

private:
  MissingPairs missing_;
};

} // namespace pydart2
