#include "collision/detector.hpp"

#include <algorithm>
#include <dart/dynamics/SoftBodyNode.hpp>
#include <dart/dynamics/SoftMeshShape.hpp>
#include <utility>

#include "base/errors.hpp"
#include "collision/engine_detectors.hpp"
#include "collision/fcl_detector.hpp"
#include "collision/native_detector.hpp"
#include "collision/ode_detector.hpp"
#include "engine/protected_members.hpp"

namespace pydart2 {

using namespace dart::collision;
using dart::constraint::ConstraintSolver;

namespace {

OdeMutex ode_mutex(ForkOrder::ode);

} // namespace

std::unique_lock<OdeMutex> lock_ode()
{
  return std::unique_lock(ode_mutex);
}

CollisionDetectorPtr make_detector(const std::string& name)
{
  const auto lock = lock_ode();
  if (name == "dart")
    return DartDetector::create();
  if (name == "fcl")
    return FclDetector::create();
  if (name == "bullet")
    return BulletDetector::create();
  if (name == "ode")
    return OdeDetector::create();
  if (name == "native")
    return NativeDetector::create();
  throw Error(Kind::value, "no collision detector '" + name + "'; there are dart, fcl, bullet, ode and native");
}

void use_detector(ConstraintSolver& solver, const CollisionDetectorPtr& detector)
{
  // Not by setCollisionDetector(): shapes that change would collide as before, as its group does not follow skeletons.
  const auto lock = lock_ode();
  solver.clearLastCollisionResult(); // it points to objects of the old detector
  if (const auto* before = dynamic_cast<const ShapeChoice*>(solver.getCollisionDetector().get()))
    dynamic_cast<ShapeChoice&>(*detector).engine_shapes = before->engine_shapes;
  auto& group = SolverMembers::group_of(solver);
  group = detector->createCollisionGroupAsSharedPtr();
  SolverMembers::detector_of(solver) = detector;
  for (const auto& skeleton : solver.getSkeletons())
    group->subscribeTo(skeleton);
}

void replace_detector(ConstraintSolver& solver)
{
  const auto lock = lock_ode();
  const auto old = solver.getCollisionDetector(); // goes before the lock
  const auto detector = make_detector(old->getType());
  if (const auto fcl = std::dynamic_pointer_cast<FCLCollisionDetector>(old)) {
    auto& mine = dynamic_cast<FclDetector&>(*detector);
    mine.setPrimitiveShapeType(fcl->getPrimitiveShapeType());
    mine.setContactPointComputationMethod(fcl->getContactPointComputationMethod());
    if (const auto* ours = dynamic_cast<const FclDetector*>(fcl.get()))
      mine.soft_at_rest = ours->soft_at_rest;
  }
  use_detector(solver, detector);
}

namespace {

/// Bullet keeps the skin of a soft body as it was when its object was made, from a mesh that other detectors bring up to
/// date: that of a copy is made from the points where they are, as the original's is then, too.
void renew_bullet(ConstraintSolver& solver)
{
  for (const auto& skeleton : solver.getSkeletons())
    for (std::size_t i = 0; i < skeleton->getNumSoftBodyNodes(); ++i)
      for (auto* node : skeleton->getSoftBodyNode(i)->getShapeNodes())
        if (auto* skin = dynamic_cast<dart::dynamics::SoftMeshShape*>(node->getShape().get()))
          skin->update();
  use_detector(solver, solver.getCollisionDetector()->cloneWithoutCollisionObjects());
}

void renew_fcl(ConstraintSolver& solver, bool shapes_changed)
{
  const auto& skeletons = solver.getSkeletons();
  const bool soft = std::any_of(
      skeletons.begin(), skeletons.end(), [](const auto& skeleton) { return skeleton->getNumSoftBodyNodes() > 0; });
  if (soft && !std::exchange(dynamic_cast<FclDetector&>(*solver.getCollisionDetector()).soft_at_rest, true))
    replace_detector(solver);
  const auto group = solver.getCollisionGroup(); // keeps the meshes' trees, which are dear to make
  if (soft || shapes_changed) {
    // The new tree depends on where the objects are when they are added; a soft one keeps its last two meshes.
    for (int i = 0; i < 2; ++i)
      group->collide(CollisionOption(false, 1));
    return use_detector(solver, solver.getCollisionDetector());
  }
  group->update();
  FclDetector::put_in_again(*group);
}

} // namespace

void place_at_once(ConstraintSolver& solver, bool at_once)
{
  if (auto* fcl = dynamic_cast<FclDetector*>(solver.getCollisionDetector().get()))
    fcl->placed_at_once = at_once;
}

void renew_detector(ConstraintSolver& solver, bool shapes_changed)
{
  const auto detector = solver.getCollisionDetector(); // no hold on the group: ODE's goes under the lock
  if (detector->getType() == "bullet")
    renew_bullet(solver);
  if (detector->getType() == "dart" || detector->getType() == "ode")
    use_detector(solver, detector); // their pairs are in the order in which the shapes came
  if (detector->getType() == "fcl")
    renew_fcl(solver, shapes_changed);
}

ShapeChoice& shape_choice(ConstraintSolver& solver)
{
  return dynamic_cast<ShapeChoice&>(*solver.getCollisionDetector());
}

void visit_detector(Archive& archive, ConstraintSolver& solver)
{
  archive.text(
      [&] { return solver.getCollisionDetector()->getType(); },
      [&](const std::string& name) { use_detector(solver, make_detector(name)); });
  auto& choice = shape_choice(solver);
  choice.engine_shapes = archive.part("engine's shapes", choice.engine_shapes);
  const auto fcl = std::dynamic_pointer_cast<FCLCollisionDetector>(solver.getCollisionDetector());
  if (!fcl)
    return;
  bool changed = false;
  archive.number(
      [&] { return static_cast<double>(fcl->getPrimitiveShapeType()); },
      [&](double type) {
        if (type != 0.0 && type != 1.0)
          Archive::refuse();
        fcl->setPrimitiveShapeType(static_cast<FCLCollisionDetector::PrimitiveShape>(type));
        changed = true;
      });
  archive.number(
      [&] { return static_cast<double>(fcl->getContactPointComputationMethod()); },
      [&](double method) {
        if (method != 0.0 && method != 1.0)
          Archive::refuse();
        fcl->setContactPointComputationMethod(
            static_cast<FCLCollisionDetector::ContactPointComputationMethod>(method));
      });
  if (changed)
    use_detector(solver, fcl); // the shapes are made anew
}

} // namespace pydart2
