#include "engine/late_ode.hpp"

#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <string>

namespace pydart2 {

namespace {

thread_local int alive = 0;

struct Placeholder final : dart::collision::DARTCollisionDetector
{
  const std::string& getType() const override { return dart::collision::OdeCollisionDetector::getStaticType(); }
};

dart::collision::CollisionDetectorPtr create()
{
  if (alive > 0)
    return std::make_shared<Placeholder>();
  return dart::collision::OdeCollisionDetector::create();
}

} // namespace

LateOde::LateOde()
{
  ++alive;
}

LateOde::~LateOde()
{
  --alive;
}

void LateOde::install()
{
  dart::collision::CollisionDetector::getFactory()->registerCreator(
      dart::collision::OdeCollisionDetector::getStaticType(), create);
}

} // namespace pydart2
