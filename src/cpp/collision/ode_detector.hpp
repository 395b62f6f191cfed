#pragma once

#include <dart/collision/ode/OdeCollisionDetector.hpp>

#include "collision/completed_detector.hpp"

namespace pydart2 {

/// The engine's detector with ODE, but that a shape that has changed is made anew where it was: the engine's own refresh
/// leaves ODE, and a plane or mesh itself, with the address of an object that is no more. And what goes wrong inside ODE
/// is an exception, after which the detector works. A mesh without normals gets some while ODE copies them. And it is
/// completed.
class OdeDetector : public CompletedDetector<dart::collision::OdeCollisionDetector>
{
public:
  static std::shared_ptr<OdeDetector> create();

  std::shared_ptr<dart::collision::CollisionDetector> cloneWithoutCollisionObjects() const override;

  bool collide(
      dart::collision::CollisionGroup* group,
      const dart::collision::CollisionOption& option,
      dart::collision::CollisionResult* result) override;
  bool collide(
      dart::collision::CollisionGroup* group1,
      dart::collision::CollisionGroup* group2,
      const dart::collision::CollisionOption& option,
      dart::collision::CollisionResult* result) override;

protected:
  std::unique_ptr<dart::collision::CollisionObject> createCollisionObject(
      const dart::dynamics::ShapeFrame* frame) override;
  void refreshCollisionObject(dart::collision::CollisionObject* object) override;

private:
  OdeDetector();
};

} // namespace pydart2
