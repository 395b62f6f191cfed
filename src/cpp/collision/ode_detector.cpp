#include "collision/ode_detector.hpp"

#include <dart/collision/ode/OdeCollisionObject.hpp>
#include <new>

#include "engine/ode_space.hpp"

namespace pydart2 {

using namespace dart::collision;

namespace {

/// The constructor is protected.
struct Object final : OdeCollisionObject
{
  Object(OdeCollisionDetector* detector, const dart::dynamics::ShapeFrame* frame) : OdeCollisionObject(detector, frame) {}
};
static_assert(sizeof(Object) == sizeof(OdeCollisionObject));

} // namespace

OdeDetector::OdeDetector()
{
  make_ode_throw();
}

std::shared_ptr<OdeDetector> OdeDetector::create()
{
  return std::shared_ptr<OdeDetector>(new OdeDetector());
}

std::shared_ptr<CollisionDetector> OdeDetector::cloneWithoutCollisionObjects() const
{
  return create();
}

bool OdeDetector::collide(CollisionGroup* group, const CollisionOption& option, CollisionResult* result)
{
  try {
    return OdeCollisionDetector::collide(group, option, result);
  } catch (...) {
    unlock_ode_space(*group);
    throw;
  }
}

bool OdeDetector::collide(
    CollisionGroup* group1, CollisionGroup* group2, const CollisionOption& option, CollisionResult* result)
{
  try {
    return OdeCollisionDetector::collide(group1, group2, option, result);
  } catch (...) {
    unlock_ode_space(*group1);
    unlock_ode_space(*group2);
    throw;
  }
}

void OdeDetector::refreshCollisionObject(CollisionObject* object)
{
  const auto* frame = object->getShapeFrame();
  const Object tried(this, frame); // if that throws, the old one is whole
  object->~CollisionObject();
  new (object) Object(this, frame);
}

} // namespace pydart2
