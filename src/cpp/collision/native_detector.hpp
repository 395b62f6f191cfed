#pragma once

#include <dart/collision/CollisionDetector.hpp>
#include <dart/collision/CollisionGroup.hpp>
#include <dart/constraint/ConstraintSolver.hpp>

#include "collision/detector.hpp"
#include "collision/native_scene.hpp"

namespace pydart2 {

/// Adds contact points to a result, no more than an option has; whether there are any.
bool report(
    const std::vector<native::Touch>& touches, const dart::collision::CollisionOption& option,
    dart::collision::CollisionResult* result);

/// The package's own detector: exact contact points of convex shapes and of meshes of triangles, made afresh in each step
/// and in an order that only the model settles. It knows nothing of soft bodies.
class NativeDetector : public dart::collision::CollisionDetector, public ShapeChoice
{
public:
  using CollisionDetector::createCollisionGroup;
  static std::shared_ptr<NativeDetector> create();

  std::shared_ptr<CollisionDetector> cloneWithoutCollisionObjects() const override { return create(); }
  const std::string& getType() const override;
  std::unique_ptr<dart::collision::CollisionGroup> createCollisionGroup() override;

  bool collide(
      dart::collision::CollisionGroup* group, const dart::collision::CollisionOption& option,
      dart::collision::CollisionResult* result) override;
  bool collide(
      dart::collision::CollisionGroup* group, dart::collision::CollisionGroup* other,
      const dart::collision::CollisionOption& option, dart::collision::CollisionResult* result) override;

  /// Not measured: 0, with a warning.
  double distance(
      dart::collision::CollisionGroup* group, const dart::collision::DistanceOption& option,
      dart::collision::DistanceResult* result) override;
  double distance(
      dart::collision::CollisionGroup* group, dart::collision::CollisionGroup* other,
      const dart::collision::DistanceOption& option, dart::collision::DistanceResult* result) override;

protected:
  std::unique_ptr<dart::collision::CollisionObject> createCollisionObject(
      const dart::dynamics::ShapeFrame* frame) override;
  void refreshCollisionObject(dart::collision::CollisionObject* object) override;

private:
  NativeDetector();

  std::vector<native::Touch> touches_;
};

/// Shapes in the order of the solver's skeletons, or in that in which they came.
class NativeGroup : public dart::collision::CollisionGroup
{
public:
  using CollisionGroup::CollisionGroup;

  void set_order(const std::vector<dart::dynamics::SkeletonPtr>& skeletons);
  native::Scene& scene();

  /// Shapes of these are looked for by others only; of what changes them there is a version.
  void set_asleep(const std::unordered_set<const dart::dynamics::Skeleton*>& asleep, int version);

  /// To be called when something else than states has changed. From then on bodies are where `pose_of` says.
  void look_again(native::PoseOf pose_of);

  /// The contacts of the shapes as they are, and of those that nearly touch or come to in a step, which have negative depths; with the touches
  /// that they are made of.
  void find(const dart::collision::CollisionOption& option, double time_step, dart::collision::CollisionResult& result);
  const std::vector<native::Touch>& touches() const { return touches_; }

protected:
  void initializeEngineData() override {}
  void addCollisionObjectToEngine(dart::collision::CollisionObject*) override { stale_ = true; }
  void addCollisionObjectsToEngine(const std::vector<dart::collision::CollisionObject*>&) override { stale_ = true; }
  void removeCollisionObjectFromEngine(dart::collision::CollisionObject*) override { stale_ = true; }
  void removeAllCollisionObjectsFromEngine() override { stale_ = true; }
  void updateCollisionGroupEngineData() override {}

private:
  std::vector<native::Object*> sorted() const;

  std::vector<const dart::dynamics::Skeleton*> order_;
  bool stale_ = true;
  std::unordered_set<const dart::dynamics::Skeleton*> asleep_;
  int version_ = 0;
  native::Scene scene_;
  native::PoseOf pose_of_;
  std::vector<native::Touch> touches_;
};

/// The solver's group if its detector is a NativeDetector, with the shapes in the order of the skeletons; else null.
NativeGroup* native_group(dart::constraint::ConstraintSolver& solver);

} // namespace pydart2
