#include "state/state_watch.hpp"

#include <algorithm>
#include <dart/dynamics/SoftBodyNode.hpp>

#include "state/blow_up.hpp"

namespace pydart2 {

StateWatch::StateWatch(SkeletonRecord& record) : skeleton_(*record.skeleton), structure_(record.structure), dofs_(record.dofs())
{
  for (std::size_t i = 0; i < skeleton_.getNumSoftBodyNodes(); ++i)
    for (auto* point : skeleton_.getSoftBodyNode(i)->getPointMasses())
      points_.push_back(point);
  saved_.resize(3 * dofs_.size() + 9 * points_.size());
}

void StateWatch::save()
{
  double* out = saved_.data();
  for (const auto* places : {&dofs_.positions, &dofs_.velocities, &dofs_.accelerations})
    for (const double* place : *places)
      *out++ = *place;
  for (const auto* point : points_)
    for (const auto* value : {&point->getPositions(), &point->getVelocities(), &point->getAccelerations()})
      out = std::copy(value->data(), value->data() + 3, out);
}

void StateWatch::restore()
{
  const auto n = static_cast<long>(dofs_.size());
  const Eigen::Map<const Eigen::VectorXd> saved(saved_.data(), static_cast<long>(saved_.size()));
  // Equal numbers are a no-op in the engine and would leave caches that hold NaN.
  skeleton_.setPositions(saved.head(n).array() + 1.0);
  skeleton_.setPositions(saved.head(n));
  skeleton_.setVelocities(saved.segment(n, n));
  skeleton_.setAccelerations(saved.segment(2 * n, n));
  long at = 3 * n;
  for (auto* point : points_) {
    point->setPositions(saved.segment<3>(at));
    point->setVelocities(saved.segment<3>(at + 3));
    point->setAccelerations(saved.segment<3>(at + 6));
    at += 9;
  }
  for (const auto* body : skeleton_.getBodyNodes())
    body->getSpatialAcceleration(); // of which the engine looks at the last that was asked for, and it may be NaN
  skeleton_.clearConstraintImpulses();
  skeleton_.setImpulseApplied(false);
  for (auto* point : points_)
    point->clearConstraintImpulse();
}

bool StateWatch::is_sane() const
{
  for (const auto* places : {&dofs_.positions, &dofs_.velocities})
    for (const double* place : *places)
      if (!sane(*place))
        return false;
  return std::all_of(points_.begin(), points_.end(), [](const PointMass* point) {
    return sane(point->getPositions()) && sane(point->getVelocities());
  });
}

void StateWatch::check_positions(double time) const
{
  check(dofs_.positions, "position", time);
  check_points(&PointMass::getPositions, "position", time);
}

void StateWatch::check_velocities(double time) const
{
  check(dofs_.velocities, "velocity", time);
  check_points(&PointMass::getVelocities, "velocity", time);
}

void StateWatch::check(const std::vector<const double*>& places, const char* what, double time) const
{
  bool all = true;
  for (const double* place : places)
    all &= sane(*place);
  if (all)
    return;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!sane(*places[i]))
      blown_up(skeleton_, "dof '" + skeleton_.getDof(i)->getName() + "'", what, *places[i], time);
}

void StateWatch::check_points(const Eigen::Vector3d& (PointMass::*read)() const, const char* what, double time) const
{
  for (const auto* point : points_)
    if (const auto& value = (point->*read)(); !sane(value))
      blown_up(
          skeleton_, "a point of soft body '" + point->getParentSoftBodyNode()->getName() + "'", what, value.cwiseAbs().maxCoeff(),
          time);
}

StateWatch& watch(SkeletonRecord& record)
{
  if (!record.watch || record.watch->structure() != record.structure)
    record.watch = std::make_shared<StateWatch>(record);
  return *record.watch;
}

} // namespace pydart2
