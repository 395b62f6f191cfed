#pragma once

#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/CollisionOption.hpp>
#include <dart/collision/CollisionResult.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

#include "collision/native_scene.hpp"

namespace pydart2 {

/// What a detector has to know of a shape to say whether it has a way for a pair.
enum class ShapeKind { box, sphere, ellipsoid, cylinder, capsule, cone, pyramid, hull, plane, mesh, heightmap, other };

ShapeKind kind_of(const dart::dynamics::Shape& shape);

/// The pairs of shapes that one of the engine's detectors has no way for: it takes a capsule for a small ball, say, or lets
/// it through. Their contacts are the native detector's.
class MissingPairs
{
public:
  using Does = bool (*)(ShapeKind, ShapeKind);

  /// `does` tells for which pairs the detector has a way; it is symmetric.
  explicit MissingPairs(Does does) : does_(does) {}

  /// To be called when shapes come, change or go.
  void forget() { group_ = nullptr; }

  /// What `engine` finds with an option, and what it would miss.
  template <class Engine>
  bool collide(
      const dart::collision::CollisionDetector& detector, dart::collision::CollisionGroup& group,
      const dart::collision::CollisionOption& option, dart::collision::CollisionResult* result, const Engine& engine)
  {
    if (!look(detector, group))
      return engine(option);
    auto rest = option;
    rest.collisionFilter = only(option.collisionFilter, false);
    const bool found = engine(rest);
    return add(option, result) || found;
  }

private:
  using FilterPtr = std::shared_ptr<dart::collision::CollisionFilter>;

  /// Looks at the shapes of a group, unless it has; whether a pair of them is missing.
  bool look(const dart::collision::CollisionDetector& detector, const dart::collision::CollisionGroup& group);
  FilterPtr only(const FilterPtr& inner, bool missing) const;
  bool add(const dart::collision::CollisionOption& option, dart::collision::CollisionResult* result);

  Does does_;
  const dart::collision::CollisionGroup* group_ = nullptr;
  std::size_t shapes_ = 0; ///< How many it had.
  std::shared_ptr<std::unordered_map<const dart::dynamics::ShapeFrame*, ShapeKind>> kinds_;
  std::vector<std::unique_ptr<native::Object>> objects_; ///< Empty: nothing is missing.
  native::Scene scene_;
  std::vector<native::Touch> touches_;
};

} // namespace pydart2
