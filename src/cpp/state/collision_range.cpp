#include "state/collision_range.hpp"

#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/ShapeNode.hpp>

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

} // namespace

void check_range(const WorldRecord& record, bool ode, double time)
{
  constexpr double surely_within = 1e7; // of each detector's range
  const auto check = [&](const BodyNode& body, const Eigen::Isometry3d& pose, double shapes) {
    const double far = pose.translation().cwiseAbs().maxCoeff();
    if (!(far + shapes <= surely_within))
      check_range(body, far, ode, time);
  };
  for (std::size_t i = 0; i < record.plan.free.size(); ++i)
    check(*record.plan.free[i].node, record.plan.free[i].pose, record.plan.free[i].reach);
  for (const auto& item : record.plan.others) {
    if (ode || !item->shapes_reach)
      item->shapes_reach = shapes_reach(*item->skeleton, ode);
    for (const auto* body : item->skeleton->getBodyNodes())
      check(*body, body->getWorldTransform(), *item->shapes_reach);
  }
}

} // namespace pydart2
