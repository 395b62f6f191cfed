#include "collision/missing_pairs.hpp"

#include <algorithm>
#include <array>
#include <dart/dynamics/EllipsoidShape.hpp>
#include <dart/dynamics/ShapeNode.hpp>

#include "collision/native_detector.hpp"

namespace pydart2 {

using namespace dart::collision;
using dart::dynamics::Shape;
using dart::dynamics::ShapeFrame;

namespace {

using Kinds = std::unordered_map<const ShapeFrame*, ShapeKind>;

/// Lets through of what another filter does only the pairs that a detector misses, or only the others.
class PartFilter final : public dart::collision::CollisionFilter
{
public:
  PartFilter(std::shared_ptr<CollisionFilter> inner, MissingPairs::Does does, std::shared_ptr<const Kinds> kinds, bool missing)
    : inner_(std::move(inner)), does_(does), kinds_(std::move(kinds)), missing_(missing)
  {
  }

  bool ignoresCollision(const CollisionObject* a, const CollisionObject* b) const override
  {
    return does_(kind(a), kind(b)) == missing_ || (inner_ != nullptr && inner_->ignoresCollision(a, b));
  }

private:
  ShapeKind kind(const CollisionObject* object) const { return kinds_->at(object->getShapeFrame()); }

  const std::shared_ptr<CollisionFilter> inner_;
  const MissingPairs::Does does_;
  const std::shared_ptr<const Kinds> kinds_;
  const bool missing_;
};

} // namespace

ShapeKind kind_of(const Shape& shape)
{
  static const std::unordered_map<std::string, ShapeKind> kinds{
      {"BoxShape", ShapeKind::box},
      {"SphereShape", ShapeKind::sphere},
      {"EllipsoidShape", ShapeKind::ellipsoid},
      {"CylinderShape", ShapeKind::cylinder},
      {"CapsuleShape", ShapeKind::capsule},
      {"ConeShape", ShapeKind::cone},
      {"PyramidShape", ShapeKind::pyramid},
      {"MultiSphereConvexHullShape", ShapeKind::hull},
      {"PlaneShape", ShapeKind::plane},
      {"MeshShape", ShapeKind::mesh},
      {"HeightmapShape", ShapeKind::heightmap}};
  if (const auto* ellipsoid = dynamic_cast<const dart::dynamics::EllipsoidShape*>(&shape); ellipsoid && ellipsoid->isSphere())
    return ShapeKind::sphere;
  const std::string& type = shape.getType();
  const auto found = kinds.find(type.substr(0, type.find(' '))); // "HeightmapShape (f)" tells its number type
  return found == kinds.end() ? ShapeKind::other : found->second;
}

bool MissingPairs::look(const CollisionDetector& detector, const CollisionGroup& group)
{
  if (group_ == &group && shapes_ == group.getNumShapeFrames() && !scene_.reordered())
    return !objects_.empty();
  group_ = &group;
  shapes_ = group.getNumShapeFrames();
  kinds_ = std::make_shared<Kinds>();
  std::array<int, static_cast<std::size_t>(ShapeKind::other) + 1> counts{};
  for (std::size_t i = 0; i < shapes_; ++i) {
    const auto* frame = group.getShapeFrame(i);
    ++counts[static_cast<std::size_t>((*kinds_)[frame] = kind_of(*frame->getShape()))];
  }
  const auto misses = [&](ShapeKind kind) {
    for (std::size_t other = 0; other < counts.size(); ++other)
      if (counts[other] > (static_cast<std::size_t>(kind) == other ? 1 : 0) && !does_(kind, static_cast<ShapeKind>(other)))
        return true;
    return false;
  };
  objects_.clear();
  std::vector<native::Object*> objects;
  for (std::size_t i = 0; i < shapes_; ++i)
    if (const auto* frame = group.getShapeFrame(i); misses((*kinds_)[frame])) {
      objects_.push_back(std::make_unique<native::Object>(const_cast<CollisionDetector*>(&detector), frame));
      objects.push_back(objects_.back().get());
    }
  scene_.set_objects(objects);
  return !objects_.empty();
}

MissingPairs::FilterPtr MissingPairs::only(const FilterPtr& inner, bool missing) const
{
  return std::make_shared<PartFilter>(inner, does_, kinds_, missing);
}

bool MissingPairs::add(const CollisionOption& option, CollisionResult* result)
{
  touches_.clear();
  scene_.find(only(option.collisionFilter, true).get(), 0.0, touches_);
  return report(touches_, option, result);
}

} // namespace pydart2
