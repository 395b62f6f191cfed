#include "state/stepping.hpp"

#include <dart/common/Console.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/PointMass.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <dart/dynamics/SoftBodyNode.hpp>
#include <algorithm>
#include <cstring>
#include <sstream>
#include <utility>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "collision/detector.hpp"
#include "collision/native_detector.hpp"
#include "contact/fast_solver.hpp"
#include "dynamics/tree_dynamics.hpp"
#include "dynamics/weightless.hpp"
#include "state/dof_state.hpp"
#include "state/held_groups.hpp"
#include "state/limits.hpp"
#include "state/sleeping.hpp"
#include "state/snapshot.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::PointMass;
using dart::dynamics::Skeleton;

constexpr const char* remedy
    = "take smaller time steps, gains or forces, and go on from world.reset() or a snapshot (world.set_blow_up(\"nan\") "
      "lets it read NaN instead)";

std::string needs_mass(const BodyNode& body)
{
  return "body '" + body.getName() + "' of skeleton '" + body.getSkeleton()->getName()
         + "' moves without mass in it or below it: give it mass, or weld it";
}

/// Also false for NaN.
bool sane(double value)
{
  return std::abs(value) <= check::huge;
}

bool sane(const Eigen::Vector3d& value)
{
  return sane(value[0]) && sane(value[1]) && sane(value[2]);
}

std::string text(double value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}

} // namespace

namespace {

/// What world.set_blow_up("nan") makes NaN of; other errors of a step are the user's to mend.
class BlowUp : public Error
{
public:
  explicit BlowUp(const std::string& message) : Error(Kind::simulation, message) {}
};

} // namespace

[[noreturn]] static void blown_up(
    const Skeleton& skeleton, const std::string& where, const char* what, double value, double time)
{
  if (const auto* body = skeleton.isMobile() ? weightless_body(skeleton) : nullptr)
    throw BlowUp("the simulation blew up at t = " + text(time) + " s: " + needs_mass(*body) + "; " + remedy);
  throw BlowUp(
      "the simulation blew up at t = " + text(time) + " s: " + what + " of " + where + " in skeleton '" + skeleton.getName()
      + "' became " + text(value) + "; " + remedy);
}

/// A skeleton's state, read where the engine keeps it, and a copy to go back to.
class StateWatch
{
public:
  StateWatch(SkeletonRecord& record) : skeleton_(*record.skeleton), structure_(record.structure), dofs_(record.dofs())
  {
    for (std::size_t i = 0; i < skeleton_.getNumSoftBodyNodes(); ++i)
      for (auto* point : skeleton_.getSoftBodyNode(i)->getPointMasses())
        points_.push_back(point);
    saved_.resize(3 * dofs_.size() + 9 * points_.size());
  }

  int structure() const { return structure_; }

  void save()
  {
    double* out = saved_.data();
    for (const auto* places : {&dofs_.positions, &dofs_.velocities, &dofs_.accelerations})
      for (const double* place : *places)
        *out++ = *place;
    for (const auto* point : points_)
      for (const auto* value : {&point->getPositions(), &point->getVelocities(), &point->getAccelerations()})
        out = std::copy(value->data(), value->data() + 3, out);
  }

  void restore()
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
    skeleton_.clearConstraintImpulses();
    skeleton_.setImpulseApplied(false);
    for (auto* point : points_)
      point->clearConstraintImpulse();
  }

  bool is_sane() const
  {
    for (const auto* places : {&dofs_.positions, &dofs_.velocities})
      for (const double* place : *places)
        if (!sane(*place))
          return false;
    return std::all_of(points_.begin(), points_.end(), [](const PointMass* point) {
      return sane(point->getPositions()) && sane(point->getVelocities());
    });
  }

  void check_positions(double time) const
  {
    check(dofs_.positions, "position", time);
    check_points(&PointMass::getPositions, "position", time);
  }

  void check_velocities(double time) const
  {
    check(dofs_.velocities, "velocity", time);
    check_points(&PointMass::getVelocities, "velocity", time);
  }

private:
  void check(const std::vector<const double*>& places, const char* what, double time) const
  {
    bool all = true;
    for (const double* place : places)
      all &= sane(*place);
    if (all)
      return;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!sane(*places[i]))
        blown_up("dof '" + skeleton_.getDof(i)->getName() + "'", what, *places[i], time);
  }

  void check_points(const Eigen::Vector3d& (PointMass::*read)() const, const char* what, double time) const
  {
    for (const auto* point : points_)
      if (const auto& value = (point->*read)(); !sane(value))
        blown_up(
            "a point of soft body '" + point->getParentSoftBodyNode()->getName() + "'", what, value.cwiseAbs().maxCoeff(),
            time);
  }

  [[noreturn]] void blown_up(const std::string& where, const char* what, double value, double time) const
  {
    pydart2::blown_up(skeleton_, where, what, value, time);
  }

  Skeleton& skeleton_;
  int structure_;
  const DofState& dofs_;
  std::vector<PointMass*> points_;
  std::vector<double> saved_;
};

namespace {

StateWatch& watch(SkeletonRecord& record)
{
  if (!record.watch || record.watch->structure() != record.structure)
    record.watch = std::make_shared<StateWatch>(record);
  return *record.watch;
}

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

/// Collision detection needs differences of coordinates: contacts of bodies that are too far out have normals that are
/// not numbers. ODE ends the process where a coordinate in cells of its hash space, 1/8 m and larger, is no 32-bit integer.
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

} // namespace

namespace {

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
  auto* ours = record.dynamics == Dynamics::fast ? item.dynamics() : nullptr;
  return ours != nullptr && ours->is_for_engine() ? nullptr : ours;
}

void accelerate(SkeletonRecord& item)
{
  put_into_inertias(item.armature, *item.skeleton);
  if (item.mover != nullptr)
    item.mover->accelerate();
  else
    item.skeleton->computeForwardDynamics();
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
void predict(const WorldRecord& record, SkeletonRecord& item, double end)
{
  auto& skeleton = *item.skeleton;
  const double dt = record.world->getTimeStep();
  item.motors.act(skeleton, item.armature, dt);
  item.mover = choose_mover(record, item);
  accelerate(item);
  if (has_integrator(record, item))
    prepare_integrator(record, item, dt);
  if (item.mover != nullptr)
    item.mover->integrate_velocities(dt);
  else
    skeleton.integrateVelocities(dt);
  item.watch->check_velocities(end);
  if (has_integrator(record, item))
    item.integrator().keep_prediction();
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
    group->look_again([&plan](const BodyNode* body) -> const Eigen::Isometry3d* {
      const int place = plan.free.find(body);
      return place < 0 ? nullptr : &plan.free[static_cast<std::size_t>(place)].pose;
    });
  if (record.sleep.asleep.empty() && solver.solver() != Solver::iterative)
    return solver.solve_step(nullptr);
  const auto wake = [&](const dart::collision::CollisionResult& contacts) {
    std::vector<dart::dynamics::SkeletonPtr> skeletons;
    const auto woken = wake_touched(record, contacts);
    for (const auto& item : woken) { // in this step through the engine's objects
      item->skeleton->clearConstraintImpulses();
      watch(*item).save();
      predict(record, *item, end);
      plan.others.push_back(item);
      skeletons.push_back(item->skeleton);
    }
    if (group != nullptr)
      group->set_asleep(record.sleep.asleep, record.sleep.version);
    return skeletons;
  };
  FastConstraintSolver::Step step{plan.other_skeletons, &plan.free, plan.same, nullptr};
  if (!record.sleep.asleep.empty())
    step.wake = wake;
  solver.solve_step(&step);
}

} // namespace

void solve_constraints(WorldRecord& record, double time)
{
  auto& solver = *record.world->getConstraintSolver();
  if (std::exchange(record.shapes_changed, false))
    use_detector(solver, solver.getCollisionDetector());
  record.sleep.contacts_found = false;
  const bool ode = solver.getCollisionDetector()->getType() == "ode";
  check_range(record, ode, time);
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

const dart::dynamics::DegreeOfFreedom* find_fastest_dof(const WorldRecord& record)
{
  const dart::dynamics::DegreeOfFreedom* fastest = nullptr;
  for (const auto& item : record.skeletons)
    for (const auto* dof : item->skeleton->getDofs())
      if (fastest == nullptr || !(std::abs(dof->getVelocity()) <= std::abs(fastest->getVelocity())))
        fastest = dof;
  return fastest;
}

/// The place to look at where the engine does not say which it is.
std::string suspect(const WorldRecord& record)
{
  for (const auto& item : record.skeletons)
    if (const auto* body = item->skeleton->isMobile() ? weightless_body(*item->skeleton) : nullptr)
      return needs_mass(*body);
  const auto* fastest = find_fastest_dof(record);
  if (fastest == nullptr)
    return "no skeleton has a dof";
  return "the fastest dof is '" + fastest->getName() + "' of skeleton '" + fastest->getSkeleton()->getName() + "', at "
         + text(fastest->getVelocity());
}

/// The skeletons whose state is not one any more; where all are, that of the fastest dof.
std::vector<SkeletonRef> insane_or_fastest(const WorldRecord& record)
{
  std::vector<SkeletonRef> found;
  for (const auto& item : record.plan.others)
    if (!item->watch->is_sane())
      found.push_back(item);
  if (const auto i = record.plan.free.find_insane(check::huge); i < record.plan.free.size())
    found.push_back(record.plan.owners[i]);
  const auto* fastest = found.empty() ? find_fastest_dof(record) : nullptr;
  for (const auto& item : record.skeletons)
    if (fastest != nullptr && item->skeleton == fastest->getSkeleton())
      found.push_back(item);
  return found;
}

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
  for (const auto& item : plan.others)
    if (item->skeleton->isMobile())
      predict(record, *item, end);
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

void go_back(WorldRecord& record)
{
  for (const auto& item : record.plan.others)
    item->watch->restore();
  record.world->getConstraintSolver()->clearLastCollisionResult(); // its forces may not be finite
}

} // namespace

void advance(WorldRecord& record)
{
  auto& world = *record.world;
  if (record.blown_up)
    return pass(record);
  if (record.deterministic)
    forget_history(record);
  for (const auto& item : make_plan(record).others)
    watch(*item).save();
  try {
    phases(record);
  } catch (const Error& error) {
    const bool blown_up = error.kind() == Kind::engine || dynamic_cast<const BlowUp*>(&error) != nullptr;
    const auto concerned = blown_up && record.nan_at_blow_up ? insane_or_fastest(record) : std::vector<SkeletonRef>();
    const std::string where = error.kind() == Kind::engine ? suspect(record) : "";
    go_back(record);
    if (!concerned.empty()) {
      for (const auto& item : concerned)
        record.become_not_numbers(*item);
      return pass(record);
    }
    if (error.kind() != Kind::engine)
      throw;
    throw Error(
        Kind::simulation,
        "the simulation blew up at t = " + text(world.getTime() + world.getTimeStep()) + " s: " + error.what() + "; " + where
            + "; " + remedy);
  }
  for (const auto& item : record.plan.others)
    if (item->skeleton->isMobile()) {
      item->skeleton->clearInternalForces();
      clear_external_forces(*item->skeleton);
      if (!item->dofs().commands_at_rest())
        item->skeleton->resetCommands();
    }
  pass(record);
  tell_of_limits(record);
  fall_asleep(record);
}

} // namespace pydart2
