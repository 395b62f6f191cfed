#pragma once

#include <dart/collision/fcl/FCLCollisionDetector.hpp>

#include "collision/completed_detector.hpp"

namespace pydart2 {

/// The engine's detector with FCL, but for seven things. Equal shapes of all worlds share the tree of their triangles,
/// which is most of what a robot takes in memory. A shape that has changed keeps its body: the engine's own refresh
/// forgets to say whose shape it is, and the next contact reads memory that was never set. And cones and pyramids
/// are where they belong: the engine makes their triangles at a pose that was never set. Skins of soft bodies meet FCL's own
/// boxes and balls at the right face. A group that was emptied is as a new one. One that is asked for no contacts
/// balances its tree, so that the order of later ones does not show it. And it is completed.
class FclDetector : public CompletedDetector<dart::collision::FCLCollisionDetector>
{
public:
  static std::shared_ptr<FclDetector> create();

  std::shared_ptr<dart::collision::CollisionDetector> cloneWithoutCollisionObjects() const override;

  std::unique_ptr<dart::collision::CollisionGroup> createCollisionGroup() override;

  using CompletedDetector::collide;
  bool collide(
      dart::collision::CollisionGroup* group, const dart::collision::CollisionOption& option,
      dart::collision::CollisionResult* result) override;

  /// Makes the tree of a group's objects as for a new group: where they are now, one after the other.
  static void put_in_again(dart::collision::CollisionGroup& group);

  /// Whether the trees of soft bodies are made of their points at rest and not, as by the engine, where they are then: a
  /// copy and what it was copied from need the same trees from there on.
  bool soft_at_rest = false;

  /// Whether new objects are put where their shapes are and not, as by the engine, at the origin until the next step: of
  /// many there FCL makes a tree that is a list. For trees that renew_detector() makes anew.
  bool placed_at_once = false;

protected:
  std::unique_ptr<dart::collision::CollisionObject> createCollisionObject(
      const dart::dynamics::ShapeFrame* frame) override;
  void refreshCollisionObject(dart::collision::CollisionObject* object) override;

private:
  FclDetector();

  std::shared_ptr<dart::collision::fcl::CollisionGeometry> geometry(const dart::dynamics::ConstShapePtr& shape);
};

} // namespace pydart2
