#include "state/stepping.hpp"

#include <dart/common/Console.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <cstring>
#include <utility>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "collision/detector.hpp"
#include "collision/native_detector.hpp"
#include "contact/fast_solver.hpp"
#include "dynamics/tree_dynamics.hpp"
#include "state/blow_up.hpp"
#include "state/collision_range.hpp"
#include "state/dof_state.hpp"
#include "state/held_groups.hpp"
#include "state/limits.hpp"
#include "state/sleeping.hpp"
#include "state/snapshot.hpp"
#include "state/state_watch.hpp"

namespace pydart2 {

void clear_impulses(dart::dynamics::Skeleton& skeleton)
{
  skeleton.clearConstraintImpulses();
  skeleton.setImpulseApplied(false);
}

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Skeleton;

/// The exact solvers take time with the cube of the rows of a group: from here on, tens of milliseconds a step.
constexpr int large_group = 1000;

void tell_of_large_groups(WorldRecord& record, double time)
{
  const int rows = fast_solver(*record.world).take_largest_group();
  if (rows <= large_group || std::exchange(record.told_of_large_group, true))
    return;
  dtwarn << "[World] at t = " << time << " s one group of bodies that touch has contacts and constraints of " << rows
         << " rows, for which an exact solver takes long; set_constraint_solver(\"iterative\") takes time with their number\n";
}

/// What moves a skeleton in this step.
TreeDynamics* choose_mover(const WorldRecord& record, SkeletonRecord& item)
{
  constexpr std::size_t many = 8;
  auto* ours = record.dynamics == Dynamics::fast ? item.dynamics() : nullptr;
  if (ours == nullptr || ours->is_for_engine())
    return nullptr;
  ours->keep_up(record.plan.changes);
  ours->set_fetch_ahead(record.skeletons.size() > many);
  return ours;
}

/// Whether a skeleton's steps may be other than the engine's.
bool has_integrator(const WorldRecord& record, const SkeletonRecord& item)
{
  return record.integrator != Integrator::engine && item.skeleton->getNumSoftBodyNodes() == 0
         && item.skeleton->getNumDofs() > 0;
}

/// Before the velocities are predicted by the engine's rule, with accelerations made implicit where that is wanted.
void prepare_integrator(const WorldRecord& record, SkeletonRecord& item, double dt)
{
  if (record.integrator == Integrator::implicit)
    item.integrator().make_implicit(item.armature, dt);
  else
    item.integrator().begin();
}

/// The velocities of a skeleton without contacts and constraints.
void predict_mobile(const WorldRecord& record, SkeletonRecord& item, double end)
{
  auto& skeleton = *item.skeleton;
  const double dt = record.world->getTimeStep();
  item.motors.act(skeleton, item.armature, dt);
  item.mover = choose_mover(record, item);
  put_into_inertias(item.armature, skeleton);
  if (item.mover != nullptr)
    item.mover->accelerate(!has_integrator(record, item));
  else
    skeleton.computeForwardDynamics();
  if (has_integrator(record, item))
    prepare_integrator(record, item, dt);
  if (item.mover != nullptr)
    item.mover->integrate_velocities(dt, record.plan.native);
  else
    skeleton.integrateVelocities(dt);
  item.watch->check_velocities(end);
  if (has_integrator(record, item))
    item.integrator().keep_prediction();
}

/// Begins the step of a skeleton: what one goes through is still in the processor's cache for the next.
void predict(const WorldRecord& record, SkeletonRecord& item, double end)
{
  watch(item).save();
  item.mover = nullptr;
  if (item.skeleton->isMobile())
    predict_mobile(record, item, end);
  check_range(record, item, end, item.mover);
  if (item.mover == nullptr) // motors look at the impulses
    return clear_impulses(*item.skeleton);
  item.mover->look_at_forces(item.dofs().commands_at_rest());
  item.mover->clear_impulses();
  item.skeleton->setImpulseApplied(false);
}

/// With those that are awake, and what their contacts wake.
void solve(WorldRecord& record, double end)
{
  auto& solver = fast_solver(*record.world);
  auto* group = native_group(solver); // with the order of the shapes
  if (group != nullptr)
    group->set_asleep(record.sleep.asleep, record.sleep.version);
  auto& plan = record.plan;
  if (group != nullptr && !plan.same)
    group->look_again([&plan](const BodyNode* body) -> native::Placed {
      const int place = plan.free.find(body);
      if (place < 0)
        return {};
      const auto& free = plan.free[static_cast<std::size_t>(place)];
      return {&free.pose, &free.angular, &free.linear};
    });
  const auto wake = [&](const dart::collision::CollisionResult& contacts) {
    std::vector<dart::dynamics::SkeletonPtr> skeletons;
    const auto woken = wake_touched(record, contacts);
    for (const auto& item : woken) { // in this step through the engine's objects
      plan.others.push_back(item);
      ++plan.begun;
      clear_impulses(*item->skeleton);
      predict(record, *item, end);
      skeletons.push_back(item->skeleton);
    }
    if (group != nullptr)
      group->set_asleep(record.sleep.asleep, record.sleep.version);
    return skeletons;
  };
  FastConstraintSolver::Step step{plan.other_skeletons, plan.jointed, plan.rigid, &plan.free, plan.same, nullptr};
  if (!record.sleep.asleep.empty())
    step.wake = wake;
  solver.solve_step(step);
}

} // namespace

void solve_constraints(WorldRecord& record, double time)
{
  auto& solver = *record.world->getConstraintSolver();
  if (std::exchange(record.shapes_changed, false))
    use_detector(solver, solver.getCollisionDetector());
  record.sleep.contacts_found = false;
  const bool ode = solver.getCollisionDetector()->getType() == "ode";
  check_range_of_free(record, time);
  check_limits(record);
  const auto lock = ode ? lock_ode() : std::unique_lock<OdeMutex>();
  solve(record, time);
  tell_of_large_groups(record, time);
  const auto most = solver.getCollisionOption().maxNumContacts;
  if (!record.told_of_contact_limit && solver.getLastCollisionResult().getNumContacts() >= most) {
    record.told_of_contact_limit = true;
    dtwarn << "[World] at t = " << time << " s there are " << most << " contacts or more, and world.max_contacts is " << most
           << ": bodies whose contacts are left out pass through each other\n";
  }
}

namespace {

/// Of the time, which goes on also where nothing else can.
void pass(WorldRecord& record)
{
  record.world->setTime(record.world->getTime() + record.world->getTimeStep());
  ++record.frame;
}

/// The whole step of a skeleton that moves freely; false where the engine's rule has to do.
bool move_freely(const WorldRecord& record, SkeletonRecord& item, double dt)
{
  const bool any = has_integrator(record, item);
  if (record.integrator == Integrator::engine || (any && record.integrator == Integrator::implicit))
    return false;
  if (any && item.integrator().moves_freely()) {
    if (record.integrator == Integrator::variational && item.integrator().step_variational(item.armature, dt))
      return true;
    if (record.integrator == Integrator::rk4) {
      HeldMotion({{item.skeleton.get(), &item.integrator(), &item.armature}}, {}).step_rk4(dt);
      return true;
    }
  }
  ++item.integrator_fallbacks;
  return false;
}

void apply_impulses(SkeletonRecord& item)
{
  if (item.mover != nullptr)
    item.mover->apply_impulses();
  else
    item.skeleton->computeImpulseForwardDynamics();
  item.skeleton->setImpulseApplied(false);
}

/// Of the bodies that the engine does not move.
void check_free(const WorldRecord& record, double end)
{
  const auto& free = record.plan.free;
  const auto i = free.find_insane(check::huge);
  if (i == free.size())
    return;
  const auto& body = free[i];
  Eigen::Vector6d positions = Eigen::Vector6d::Zero(), velocities;
  positions.tail<3>() = body.pose.translation();
  velocities << body.angular, body.linear;
  for (const auto& [values, what] : {std::pair(velocities, "velocity"), std::pair(positions, "position")})
    for (int dof = 0; dof < 6; ++dof)
      if (!sane(values[dof]))
        blown_up(*body.skeleton, "dof '" + body.joint->getDofName(static_cast<std::size_t>(dof)) + "'", what, values[dof], end);
}

/// World::step() up to the time, in the same order. Checks come before what would fail an assertion of the engine.
void phases(WorldRecord& record)
{
  auto& world = *record.world;
  const double dt = world.getTimeStep(), end = world.getTime() + dt;
  auto& plan = record.plan;
  while (plan.begun < plan.others.size()) {
    auto& item = *plan.others[plan.begun++];
    predict(record, item, end);
  }
  plan.free.predict(world.getGravity(), dt);
  check_free(record, end);
  solve_constraints(record, end);
  for (const auto& item : plan.others) {
    auto& skeleton = *item->skeleton;
    if (!skeleton.isMobile())
      continue;
    if (skeleton.isImpulseApplied()) {
      apply_impulses(*item);
      item->watch->check_velocities(end);
    }
  }
  auto& iterative = fast_solver(world).iterative();
  const bool sweeps = fast_solver(world).solver() == Solver::iterative;
  if (sweeps) {
    iterative.move_free_bodies(dt);
    iterative.add_corrections();
  }
  const auto held = move_held_groups(record, dt);
  plan.free.integrate(dt);
  check_free(record, end);
  for (const auto& item : plan.others) {
    auto& skeleton = *item->skeleton;
    if (!skeleton.isMobile())
      continue;
    if (held.count(&skeleton) != 0 || move_freely(record, *item, dt))
      item->watch->check_velocities(end);
    else if (item->mover != nullptr)
      item->mover->integrate_positions(dt);
    else
      skeleton.integratePositions(dt);
    item->watch->check_positions(end);
  }
  if (sweeps)
    iterative.take_off_corrections();
  plan.free.give_back(dt);
}

/// As Skeleton::clearExternalForces(), which locks a pointer and marks its caches for every body, only for those that
/// have a force.
void clear_external_forces(Skeleton& skeleton)
{
  static const Eigen::Vector6d none = Eigen::Vector6d::Zero();
  if (skeleton.getNumSoftBodyNodes() > 0)
    return skeleton.clearExternalForces();
  for (auto* body : skeleton.getBodyNodes())
    if (const auto& force = body->getExternalForceLocal(); std::memcmp(force.data(), none.data(), sizeof none) != 0)
      body->clearExternalForces();
}

/// As the engine does after a step.
void clear_forces(SkeletonRecord& item)
{
  auto& skeleton = *item.skeleton;
  if (item.mover != nullptr && item.mover->forces_at_rest())
    return item.mover->clear_internal_forces();
  skeleton.clearInternalForces();
  clear_external_forces(skeleton);
  if (!item.dofs().commands_at_rest())
    skeleton.resetCommands();
}

void go_back(WorldRecord& record)
{
  for (std::size_t i = 0; i < record.plan.begun; ++i)
    record.plan.others[i]->watch->restore();
  record.world->getConstraintSolver()->clearLastCollisionResult(); // its forces may not be finite
}

} // namespace

void advance(WorldRecord& record)
{
  if (record.blown_up)
    return pass(record);
  if (record.deterministic)
    forget_history(record);
  make_plan(record);
  try {
    phases(record);
  } catch (const Error& error) {
    const bool blown_up = error.kind() == Kind::engine || dynamic_cast<const BlowUp*>(&error) != nullptr;
    const auto concerned = blown_up && record.nan_at_blow_up ? insane_or_suspect(record) : std::vector<SkeletonRef>();
    const std::string where = error.kind() == Kind::engine ? suspect(record) : "";
    go_back(record);
    if (!concerned.empty()) {
      for (const auto& item : concerned)
        record.become_not_numbers(*item);
      return pass(record);
    }
    if (error.kind() != Kind::engine)
      throw;
    engine_failed(record, error.what(), where);
  }
  for (const auto& item : record.plan.others)
    if (item->skeleton->isMobile())
      clear_forces(*item);
  pass(record);
  tell_of_limits(record);
  fall_asleep(record);
}

} // namespace pydart2
