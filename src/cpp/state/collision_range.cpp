#include "state/collision_range.hpp"

#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/ShapeNode.hpp>

#include "dynamics/tree_dynamics.hpp"
#include "state/blow_up.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Skeleton;

/// At most so far from its body's origin a shape is, and with ODE any point of it.
double reach(const dart::dynamics::ShapeNode& node, bool ode)
{
  double far = node.getRelativeTransform().translation().cwiseAbs().sum();
  if (ode && !node.getShape()->is<dart::dynamics::PlaneShape>())
    far += node.getShape()->getBoundingBox().computeFullExtents().sum();
  return far;
}

double shapes_reach(const Skeleton& skeleton, bool ode)
{
  double most = 0.0;
  for (const auto* body : skeleton.getBodyNodes())
    for (const auto* node : body->getShapeNodes())
      if (const double far = reach(*node, ode); !(far <= most))
        most = far;
  return most;
}

void check_range(const BodyNode& body, double far, bool ode, double time)
{
  const double limit = ode ? 1e8 : 1e12;
  const auto check = [&](double distance, const std::string& what) {
    if (!(distance <= limit))
      throw BlowUp(
          "the simulation left the range of the collision detector at t = " + text(time) + " s: " + what + " '"
          + body.getName() + "' of skeleton '" + body.getSkeleton()->getName() + "' is " + text(distance)
          + " m from the origin along an axis, the range is " + text(limit) + " m");
  };
  check(far, "body");
  for (const auto* node : body.getShapeNodes())
    check(far + reach(*node, ode), "a shape of body");
}

constexpr double surely_within = 1e7; ///< m, of each detector's range.

/// A body whose shapes are no further from its origin than `shapes`.
void check_range(const BodyNode& body, const Eigen::Isometry3d& pose, double shapes, bool ode, double time)
{
  const double far = pose.translation().cwiseAbs().maxCoeff();
  if (!(far + shapes <= surely_within))
    check_range(body, far, ode, time);
}

bool has_ode(const WorldRecord& record)
{
  return record.world->getConstraintSolver()->getCollisionDetector()->getType() == "ode";
}

} // namespace

void check_range(const WorldRecord& record, SkeletonRecord& item, double time, const TreeDynamics* mover)
{
  const bool ode = has_ode(record);
  if (ode || !item.shapes_reach)
    item.shapes_reach = shapes_reach(*item.skeleton, ode);
  if (mover != nullptr && mover->is_within(surely_within - *item.shapes_reach))
    return;
  for (const auto* body : item.skeleton->getBodyNodes())
    check_range(*body, body->getWorldTransform(), *item.shapes_reach, ode, time);
}

void check_range_of_free(const WorldRecord& record, double time)
{
  const bool ode = has_ode(record);
  const auto& free = record.plan.free;
  for (std::size_t i = 0; i < free.size(); ++i)
    check_range(*free[i].node, free[i].pose, free[i].reach, ode, time);
}

} // namespace pydart2
