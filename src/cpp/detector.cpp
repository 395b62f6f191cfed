#include "detector.hpp"

#include <dart/collision/bullet/BulletCollisionDetector.hpp>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/ConeShape.hpp>

#include "errors.hpp"

namespace pydart2 {

using namespace dart::collision;
using dart::constraint::ConstraintSolver;

std::unique_lock<std::recursive_mutex> lock_ode()
{
  static std::recursive_mutex mutex;
  return std::unique_lock(mutex);
}

CollisionDetectorPtr make_detector(const std::string& name)
{
  const auto lock = lock_ode();
  if (name == "dart")
    return DARTCollisionDetector::create();
  if (name == "fcl")
    return FCLCollisionDetector::create();
  if (name == "bullet")
    return BulletCollisionDetector::create();
  if (name == "ode")
    return OdeCollisionDetector::create();
  throw Error(Kind::value, "no collision detector '" + name + "'; there are dart, fcl, bullet and ode");
}

void use_detector(ConstraintSolver& solver, const CollisionDetectorPtr& detector)
{
  const auto lock = lock_ode();
  solver.clearLastCollisionResult(); // it points to objects of the old detector
  solver.setCollisionDetector(detector);
  // The engine adds the shapes of today to the new group; subscribed, it follows the skeletons.
  auto& group = *solver.getCollisionGroup();
  group.removeAllShapeFrames();
  for (const auto& skeleton : solver.getSkeletons())
    group.subscribeTo(skeleton);
}

bool has_cones(const dart::simulation::World& world)
{
  for (std::size_t i = 0; i < world.getNumSkeletons(); ++i)
    for (const auto* body : world.getSkeleton(i)->getBodyNodes())
      for (const auto* node : body->getShapeNodesWith<dart::dynamics::CollisionAspect>())
        if (node->getShape()->is<dart::dynamics::ConeShape>())
          return true;
  return false;
}

void spare_fcl_cones(dart::simulation::World& world)
{
  auto& solver = *world.getConstraintSolver();
  if (solver.getCollisionDetector()->getType() != "fcl" || !has_cones(world))
    return;
  dtwarn << "FCL of this engine puts cones in random places: the world's collision detector is Bullet now.\n";
  solver.setCollisionDetector(make_detector("bullet"));
}

void renew_detector(ConstraintSolver& solver)
{
  const auto detector = solver.getCollisionDetector();
  const auto group = solver.getCollisionGroup(); // keeps the meshes' trees, which are dear to make
  if (detector->getType() == "bullet")
    use_detector(solver, detector->cloneWithoutCollisionObjects());
  if (detector->getType() == "fcl") {
    // The new tree depends on where the objects are when they are added; a soft one keeps its last two meshes.
    for (int i = 0; i < 2; ++i)
      group->collide(CollisionOption(false, 1));
    solver.setCollisionDetector(DARTCollisionDetector::create()); // the same detector would be ignored
    use_detector(solver, detector);
  }
}

void visit_detector(Archive& archive, ConstraintSolver& solver)
{
  archive.text(
      [&] { return solver.getCollisionDetector()->getType(); },
      [&](const std::string& name) { use_detector(solver, make_detector(name)); });
  const auto fcl = std::dynamic_pointer_cast<FCLCollisionDetector>(solver.getCollisionDetector());
  if (!fcl)
    return;
  bool changed = false;
  archive.number(
      [&] { return static_cast<double>(fcl->getPrimitiveShapeType()); },
      [&](double type) {
        fcl->setPrimitiveShapeType(static_cast<FCLCollisionDetector::PrimitiveShape>(type));
        changed = true;
      });
  archive.number(
      [&] { return static_cast<double>(fcl->getContactPointComputationMethod()); },
      [&](double method) {
        fcl->setContactPointComputationMethod(
            static_cast<FCLCollisionDetector::ContactPointComputationMethod>(method));
      });
  if (changed) { // the shapes are made anew
    use_detector(solver, DARTCollisionDetector::create());
    use_detector(solver, fcl);
  }
}

} // namespace pydart2
