#include "state/snapshot.hpp"

#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/PointMass.hpp>
#include <dart/dynamics/SoftBodyNode.hpp>
#include <limits>
#include <utility>

#include "base/archive.hpp"
#include "base/checks.hpp"
#include "base/errors.hpp"
#include "collision/detector.hpp"
#include "contact/fast_solver.hpp"
#include "engine/protected_members.hpp"
#include "state/constraint_record.hpp"
#include "state/sleeping.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::DegreeOfFreedom;
using dart::dynamics::PointMass;
using dart::dynamics::Skeleton;
using Vector = const Eigen::VectorXd&;

/// Not within limits that may have been set since; setCommand() takes what they leave.
void set_command(DegreeOfFreedom& dof, double command)
{
  dof.setCommand(command);
  if (dof.getCommand() == command)
    return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto force = dof.getForceLimits(), velocity = dof.getVelocityLimits(), acceleration = dof.getAccelerationLimits();
  dof.setForceLimits(-infinity, infinity);
  dof.setVelocityLimits(-infinity, infinity);
  dof.setAccelerationLimits(-infinity, infinity);
  dof.setCommand(command);
  dof.setForceLimits(force);
  dof.setVelocityLimits(velocity);
  dof.setAccelerationLimits(acceleration);
}

void visit_dofs(Archive& archive, Skeleton& skeleton)
{
  // Positions and velocities are set twice: the engine takes 0 for equal to -0 and would keep what it has.
  archive.vector(
      [&] { return skeleton.getPositions(); },
      [&](Vector q) {
        skeleton.setPositions(q.array() + 1.0);
        skeleton.setPositions(q);
      });
  archive.vector(
      [&] { return skeleton.getVelocities(); },
      [&](Vector dq) {
        skeleton.setVelocities(dq.array() + 1.0);
        skeleton.setVelocities(dq);
      });
  archive.vector([&] { return skeleton.getAccelerations(); }, [&](Vector ddq) { skeleton.setAccelerations(ddq); });
  for (auto* dof : skeleton.getDofs()) {
    // A force is also the command of a dof whose actuator takes forces, so it comes first.
    archive.number([&] { return dof->getForce(); }, [&](double force) { dof->setForce(force); });
    archive.number([&] { return dof->getCommand(); }, [&](double command) { set_command(*dof, command); });
    archive.number(
        [&] { return dof->getConstraintImpulse(); }, [&](double impulse) { dof->setConstraintImpulse(impulse); });
  }
}

void visit_body(Archive& archive, BodyNode& body)
{
  archive.vector(
      [&] { return body.getExternalForceLocal(); },
      [&](Vector force) { body.setAspectState(BodyNode::AspectState(Eigen::Vector6d(force))); });
  archive.vector([&] { return body.getConstraintImpulse(); }, [&](Vector impulse) { body.setConstraintImpulse(impulse); });
}

void visit_point(Archive& archive, PointMass& point)
{
  archive.vector([&] { return point.getPositions(); }, [&](Vector value) { point.setPositions(value); });
  archive.vector([&] { return point.getVelocities(); }, [&](Vector value) { point.setVelocities(value); });
  archive.vector([&] { return point.getAccelerations(); }, [&](Vector value) { point.setAccelerations(value); });
  auto& force = PointMembers::external_force(point);
  archive.vector([&] { return force; }, [&](Vector value) { force = value; });
  archive.vector(
      [&] { return point.getConstraintImpulses(); },
      [&](Vector value) { point.setConstraintImpulse(Eigen::Vector3d(value), true); });
}

/// Motors without a target have zeros.
void visit_motors(Archive& archive, SkeletonRecord& item)
{
  auto& motors = item.motors;
  const Targets none(static_cast<long>(item.skeleton->getNumDofs()));
  Targets targets = motors.targets() ? *motors.targets() : none;
  for (auto* values : {&targets.q, &targets.dq, &targets.kp, &targets.kd})
    archive.vector([&] { return *values; }, [&](Vector value) { *values = value; });
  archive.number(
      [&] { return static_cast<double>(targets.compensation); },
      [&](double value) {
        if (value != 0.0 && value != 1.0 && value != 2.0)
          Archive::refuse();
        targets.compensation = static_cast<Targets::Compensation>(value);
      });
  if (archive.is_in() && targets.any())
    motors.set(targets);
  else if (archive.is_in())
    motors.clear();
}

void visit(Archive& archive, WorldRecord& record)
{
  auto& world = *record.world;
  archive.number([&] { return world.getTime(); }, [&](double time) { world.setTime(time); });
  archive.number(
      [&] { return static_cast<double>(record.frame); }, [&](double frame) {
        if (!(frame >= 0.0 && frame <= 9e15))
          Archive::refuse();
        record.frame = static_cast<long>(frame);
      });
  for (const auto& item : record.skeletons) {
    auto& skeleton = *item->skeleton;
    visit_dofs(archive, skeleton);
    for (auto* body : skeleton.getBodyNodes())
      visit_body(archive, *body);
    for (std::size_t i = 0; i < skeleton.getNumSoftBodyNodes(); ++i)
      for (auto* point : skeleton.getSoftBodyNode(i)->getPointMasses())
        visit_point(archive, *point);
  }
  for (const auto& item : record.skeletons)
    visit_motors(archive, *item);
}

/// A state from before there were motors, with none.
std::vector<double> with_motors(const WorldRecord& record, std::vector<double> state, std::size_t size)
{
  std::size_t motors = 0;
  for (const auto& item : record.skeletons)
    motors += 4 * item->skeleton->getNumDofs() + 1;
  if (state.size() + motors == size)
    state.resize(size, 0.0);
  return state;
}

} // namespace

std::vector<double> state_of(WorldRecord& record)
{
  if (record.blown_up)
    throw Error(Kind::simulation, "the world has blown up and has no state to copy; reset() or restore() it first");
  Archive archive;
  visit(archive, record);
  const auto sleep = sleep_numbers(record);
  archive.numbers.insert(archive.numbers.end(), sleep.begin(), sleep.end());
  const auto memory = fast_solver(*record.world).memory();
  archive.numbers.insert(archive.numbers.end(), memory.begin(), memory.end());
  return std::move(archive.numbers);
}

void restore_state(WorldRecord& record, const std::vector<double>& saved)
{
  auto& solver = fast_solver(*record.world);
  Archive now;
  visit(now, record);
  auto size = now.numbers.size();
  const auto state = with_motors(record, saved, size);
  const auto sleep_begin = size;
  size += count_sleep_numbers(record, state, size);
  if (state.size() < size || (state.size() > size && !solver.warm_start()))
    check::size(static_cast<long>(state.size()), size, "the snapshot");
  if (!Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<long>(state.size())).allFinite())
    throw Error(Kind::value, "the snapshot must be finite");
  const auto end = state.begin() + static_cast<std::ptrdiff_t>(size);
  if (!solver.remember({end, state.end()}))
    throw Error(Kind::value, "the snapshot does not end with what a solver with a warm start remembers");
  wake_all(record);
  Archive archive({}, {state.begin(), end});
  visit(archive, record);
  restore_sleep(record, state.data() + sleep_begin);
  record.become_numbers();
  forget_history(record);
}

void forget_history(WorldRecord& record)
{
  auto& solver = *record.world->getConstraintSolver();
  solver.clearLastCollisionResult(); // it points to objects of the old detector
  const bool shapes_changed = std::exchange(record.shapes_changed, false);
  if (shapes_changed)
    use_detector(solver, solver.getCollisionDetector());
  renew_detector(solver, shapes_changed);
  for (auto& constraint : record.constraints)
    renew(constraint, solver);
}

} // namespace pydart2
