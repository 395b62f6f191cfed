#pragma once

#include <dart/collision/ode/OdeCollisionDetector.hpp>

namespace pydart2 {

/// The engine's detector with ODE, but that a shape that has changed keeps its body: the engine's own refresh leaves
/// ODE with the address of an object that is no more, and the next contact reads it.
class OdeDetector : public dart::collision::OdeCollisionDetector
{
public:
  static std::shared_ptr<OdeDetector> create();

  std::shared_ptr<dart::collision::CollisionDetector> cloneWithoutCollisionObjects() const override;

protected:
  void refreshCollisionObject(dart::collision::CollisionObject* object) override;

private:
  OdeDetector() = default;
};

} // namespace pydart2
