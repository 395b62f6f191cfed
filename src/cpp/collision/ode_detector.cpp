#include "collision/ode_detector.hpp"

#include <dart/collision/ode/OdeCollisionObject.hpp>

namespace pydart2 {

using namespace dart::collision;

namespace {

/// The member is protected: a derived class may name it.
struct Object : OdeCollisionObject
{
  static dGeomID geometry(const OdeCollisionObject& object) { return (object.*(&Object::getOdeGeomId))(); }
};

} // namespace

std::shared_ptr<OdeDetector> OdeDetector::create()
{
  return std::shared_ptr<OdeDetector>(new OdeDetector());
}

std::shared_ptr<CollisionDetector> OdeDetector::cloneWithoutCollisionObjects() const
{
  return create();
}

void OdeDetector::refreshCollisionObject(CollisionObject* object)
{
  OdeCollisionDetector::refreshCollisionObject(object);
  dGeomSetData(Object::geometry(static_cast<const OdeCollisionObject&>(*object)), object);
}

} // namespace pydart2
