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

  struct Known
  {
    const dart::dynamics::ShapeFrame* frame;
    const dart::dynamics::Frame* parent;
    dart::dynamics::ConstShapePtr shape; ///< Kept, so that no other one gets its address.
    std::size_t version;
    bool operator==(const Known& other) const
    {
      return frame == other.frame && parent == other.parent && shape == other.shape && version == other.version;
    }
  };

  /// Looks at the shapes of a group; whether a pair of them is missing.
  bool look(const dart::collision::CollisionDetector& detector, const dart::collision::CollisionGroup& group);
  FilterPtr only(const FilterPtr& inner, bool missing) const;
  bool add(const dart::collision::CollisionOption& option, dart::collision::CollisionResult* result);

  Does does_;
  const dart::collision::CollisionGroup* group_ = nullptr;
  std::vector<Known> known_, seen_;
  std::shared_ptr<std::unordered_map<const dart::dynamics::ShapeFrame*, ShapeKind>> kinds_;
  std::vector<std::unique_ptr<native::Object>> objects_; ///< Empty: nothing is missing.
  native::Scene scene_;
  std::vector<native::Touch> touches_;
};

} // namespace pydart2
