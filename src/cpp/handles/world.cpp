#include "handles/world.hpp"

#include <algorithm>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/SoftBodyNode.hpp>
#include <limits>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "base/interrupt.hpp"
#include "base/messages.hpp"
#include "collision/detector.hpp"
#include "contact/fast_solver.hpp"
#include "engine/engine_access.hpp"
#include "loading/loading.hpp"
#include "state/contact.hpp"
#include "state/manager.hpp"
#include "state/sleeping.hpp"
#include "state/state.hpp"
#include "state/stepping.hpp"
#include "state/world_states.hpp"

namespace pydart2 {

namespace {

dart::simulation::WorldPtr make_world(double time_step)
{
  check::positive(time_step, "time step");
  auto world = dart::simulation::World::create();
  world->setTimeStep(time_step);
  return world;
}

void record(WorldRecord& world)
{
  const auto states = static_cast<std::size_t>(num_states(world));
  const auto& frame = world.recording.add(states, num_contacts(world), world.layout, world.world->getTime());
  write_states(world, frame.state);
  write_contacts(world, frame.contacts());
  for (const auto& skeleton : world.skeletons)
    skeleton->recorded = true;
}

void reset_skeleton(dart::dynamics::Skeleton& skeleton)
{
  skeleton.resetCommands();
  skeleton.resetPositions();
  skeleton.resetVelocities();
  skeleton.resetAccelerations();
  skeleton.resetGeneralizedForces();
  skeleton.clearExternalForces();
  skeleton.clearConstraintImpulses();
  for (std::size_t i = 0; i < skeleton.getNumSoftBodyNodes(); ++i)
    for (auto* point : skeleton.getSoftBodyNode(i)->getPointMasses()) {
      point->resetPositions();
      point->resetVelocities();
      point->resetAccelerations();
      point->resetForces();
    }
}

const Frame& kept_frame(const WorldRecord& world, long index)
{
  const Frame* frame = world.recording.find(index);
  if (frame == nullptr)
    throw Error(
        Kind::index,
        "frame " + std::to_string(index) + " is not kept; the recording has frames "
            + std::to_string(world.recording.first_frame()) + " to " + std::to_string(world.recording.num_frames() - 1));
  return *frame;
}

} // namespace

void restart()
{
  Manager::instance().restart();
  messages::forget();
}

WorldHandle::WorldHandle(WorldRef record) : record_(std::move(record)) {}

WorldHandle::WorldHandle(double time_step) : record_(Manager::instance().add(make_world(time_step))) {}

WorldHandle WorldHandle::load(const ModelSource& source)
{
  return WorldHandle(Manager::instance().add(with_ode([&] { return load_world(source); }), source.packed()));
}

WorldHandle WorldHandle::find(long id)
{
  return WorldHandle(Manager::instance().find(id));
}

WorldRecord& WorldHandle::world() const
{
  record_->check();
  return *record_;
}

WorldRecord& WorldHandle::to_change()
{
  auto& record = world();
  wake_all(record);
  return record;
}

void WorldHandle::destroy()
{
  if (record_->state != WorldRecord::State::destroyed)
    Manager::instance().destroy(*record_);
}

int WorldHandle::num_skeletons() const
{
  return static_cast<int>(world().skeletons.size());
}

SkeletonHandle WorldHandle::skeleton(long index) const
{
  const auto& skeletons = world().skeletons;
  return {record_, skeletons[check::index(index, skeletons.size(), "skeleton")]};
}

int WorldHandle::add_skeleton(const ModelSource& source)
{
  record_->add(load_skeleton(source), source.packed());
  return static_cast<int>(record_->skeletons.size()) - 1;
}

int WorldHandle::add_empty_skeleton(const std::string& name)
{
  auto& record = world();
  if (name.empty())
    throw Error(Kind::value, "a skeleton needs a name");
  record.add(dart::dynamics::Skeleton::create(name), {});
  return static_cast<int>(record.skeletons.size()) - 1;
}

void WorldHandle::remove_skeleton(long index)
{
  auto& record = world();
  const auto i = check::index(index, record.skeletons.size(), "skeleton");
  record.about_to_change(*record.skeletons[i]);
  const auto skeleton = record.skeletons[i]->skeleton;
  auto& solver = *record.world->getConstraintSolver();
  for (auto it = record.constraints.begin(); it != record.constraints.end();) {
    const bool uses = it->skeleton1 == skeleton || it->skeleton2 == skeleton;
    if (uses)
      remove(*it, solver);
    it = uses ? record.constraints.erase(it) : std::next(it);
  }
  const auto& bodies = skeleton->getBodyNodes();
  forget_in_filter(record, {bodies.begin(), bodies.end()});
  const auto lock = lock_ode();
  solver.clearLastCollisionResult(); // it points to collision objects that go
  record.world->removeSkeleton(skeleton);
  ++record.skeletons[i]->structure; // parts of a skeleton without a world are refused
  ++record.layout;
  record.skeletons.erase(record.skeletons.begin() + static_cast<long>(i));
  record.recording.each_contact([i](double* row) { forget_skeleton(row, static_cast<int>(i)); });
  forget_sleeper(record, static_cast<int>(i));
}

double WorldHandle::time() const
{
  return world().world->getTime();
}

void WorldHandle::set_time(double time)
{
  check::finite(time, "time");
  world().world->setTime(time);
}

double WorldHandle::time_step() const
{
  return world().world->getTimeStep();
}

void WorldHandle::set_time_step(double time_step)
{
  check::positive(time_step, "time step");
  to_change().world->setTimeStep(time_step);
}

Eigen::Vector3d WorldHandle::gravity() const
{
  return world().world->getGravity();
}

void WorldHandle::set_gravity(const Eigen::Vector3d& gravity)
{
  check::finite(gravity, "gravity");
  to_change().world->setGravity(gravity);
}

long WorldHandle::frame() const
{
  return world().frame;
}

void WorldHandle::reset()
{
  auto& record = to_change();
  record.become_numbers();
  record.world->reset();
  for (const auto& skeleton : record.skeletons)
    reset_skeleton(*skeleton->skeleton);
  if (record.frame > 0) // a fresh world's detector has the engine's own order of contacts
    pydart2::forget_history(record);
  fast_solver(*record.world).forget();
  record.frame = 0;
  if (record.recording.enabled())
    clear_recording();
}

void WorldHandle::step(long count)
{
  if (count < 0)
    throw Error(Kind::value, "the number of steps must be zero or positive, got " + std::to_string(count));
  for (long i = 0; i < count; ++i) {
    advance(*record_);
    if (record_->recording.enabled())
      record(*record_);
    Interruptible::poll();
  }
}

void WorldHandle::check_collision()
{
  pydart2::check_collision(*record_);
}

void WorldHandle::states(Output& into) const
{
  const auto& record = world();
  write_states(record, into.vector(num_states(record)));
}

void WorldHandle::set_states(const VectorIn& states)
{
  auto& record = world();
  check::size(states.size, static_cast<std::size_t>(num_states(record)), "world states");
  check::finite(states, "world states");
  read_states(record, states.data);
}

std::string WorldHandle::collision_detector() const
{
  return world().world->getConstraintSolver()->getCollisionDetector()->getType();
}

void WorldHandle::set_collision_detector(const std::string& name)
{
  use_detector(*to_change().world->getConstraintSolver(), make_detector(name));
}

void WorldHandle::use_engine_shapes()
{
  shape_choice(*to_change().world->getConstraintSolver()).engine_shapes = true;
}

std::string WorldHandle::dynamics() const
{
  return name_of(world().dynamics);
}

void WorldHandle::set_dynamics(const std::string& name)
{
  auto& record = to_change();
  const auto dynamics = dynamics_named(name);
  if (dynamics != Dynamics::fast && record.integrator != Integrator::engine)
    throw Error(
        Kind::value, "integrator '" + std::string(name_of(record.integrator))
                         + "' needs the fast dynamics; set_integrator(\"engine\") comes first");
  record.dynamics = dynamics;
}

std::string WorldHandle::integrator() const
{
  return name_of(world().integrator);
}

void WorldHandle::set_integrator(const std::string& name)
{
  auto& record = to_change();
  const auto integrator = integrator_named(name);
  if (integrator != Integrator::engine && record.dynamics != Dynamics::fast)
    throw Error(Kind::value, "integrator '" + name + "' needs the fast dynamics; world.set_dynamics(\"fast\") comes first");
  record.integrator = integrator;
  for (const auto& item : record.skeletons)
    item->integrator_fallbacks = 0;
}

std::string WorldHandle::constraint_solver() const
{
  return name_of(fast_solver(*world().world).solver());
}

void WorldHandle::set_constraint_solver(const std::string& name)
{
  auto& solver = fast_solver(*to_change().world);
  solver.set_solver(solver_named(name));
  solver.iterative().options = {}; // they belong to the choice
}

void WorldHandle::iterative_options(Output& out) const
{
  const auto numbers = numbers_of(fast_solver(*world().world).iterative().options);
  vector(out, numbers.size()) = numbers;
}

void WorldHandle::set_iterative_options(const VectorIn& options)
{
  auto& solver = fast_solver(*to_change().world);
  solver.iterative().options = options_of(options.eigen());
  solver.set_solver(Solver::iterative);
}

int WorldHandle::solver_iterations() const
{
  return fast_solver(*world().world).iterative().iterations_used();
}

double WorldHandle::solver_residual() const
{
  return fast_solver(*world().world).iterative().residual();
}

bool WorldHandle::deterministic() const
{
  return world().deterministic;
}

void WorldHandle::set_deterministic(bool enable)
{
  world().deterministic = enable;
}

bool WorldHandle::nan_at_blow_up() const
{
  return world().nan_at_blow_up;
}

void WorldHandle::set_nan_at_blow_up(bool enable)
{
  world().nan_at_blow_up = enable;
}

bool WorldHandle::contact_reduction() const
{
  return fast_solver(*world().world).contact_reduction();
}

void WorldHandle::set_contact_reduction(bool enable)
{
  fast_solver(*to_change().world).set_contact_reduction(enable);
}

bool WorldHandle::warm_start() const
{
  return fast_solver(*world().world).warm_start();
}

void WorldHandle::set_warm_start(bool enable)
{
  fast_solver(*to_change().world).set_warm_start(enable);
}

void WorldHandle::sleeping_options(Output& out) const
{
  const auto& sleep = world().sleep;
  auto options = vector(out, sleep.enabled ? 3 : 0);
  if (sleep.enabled)
    options << sleep.linear, sleep.angular, sleep.seconds;
}

void WorldHandle::set_sleeping_options(const VectorIn& options)
{
  auto& record = to_change();
  auto& sleep = record.sleep;
  if (options.size != 0) {
    check::size(options.size, 3, "the settings of sleep");
    for (long i = 0; i < 3; ++i)
      check::positive(options.data[i], "a setting of sleep");
    sleep.linear = options.data[0];
    sleep.angular = options.data[1];
    sleep.seconds = options.data[2];
  }
  sleep.enabled = options.size != 0;
  find_awake(record);
}

long WorldHandle::max_contacts() const
{
  const auto most = fast_solver(*world().world).getCollisionOption().maxNumContacts;
  return most == unlimited_contacts ? 0 : static_cast<long>(most);
}

void WorldHandle::set_max_contacts(long most)
{
  if (most < 0 || most > static_cast<long>(unlimited_contacts))
    throw Error(Kind::value, "the number of contacts must be positive, or None for no limit, got " + std::to_string(most));
  auto& record = to_change();
  fast_solver(*record.world).getCollisionOption().maxNumContacts
      = most == 0 ? unlimited_contacts : static_cast<std::size_t>(most);
  record.told_of_contact_limit = false;
}

double WorldHandle::constraint_error_reduction() const
{
  return fast_solver(*world().world).error_reduction();
}

void WorldHandle::set_constraint_error_reduction(double share)
{
  if (!(share >= 0.0 && share <= 1.0))
    throw Error(Kind::value, "a share of an error is a number from 0 to 1, got " + std::to_string(share));
  fast_solver(*to_change().world).set_error_reduction(share);
}

double WorldHandle::contact_memory_limit() const
{
  return fast_solver(*world().world).memory_limit();
}

void WorldHandle::set_contact_memory_limit(double bytes)
{
  check::positive(bytes, "contact memory limit");
  fast_solver(*world().world).set_memory_limit(bytes);
}

int WorldHandle::num_contacts() const
{
  return static_cast<int>(pydart2::num_contacts(world()));
}

void WorldHandle::contacts(Output& out) const
{
  const auto& record = world();
  write_contacts(record, out.matrix(static_cast<long>(pydart2::num_contacts(record)), contact_columns));
}

void WorldHandle::add_ball_joint_constraint(
    const BodyNodeHandle& body1, const BodyNodeHandle& body2, const Eigen::Vector3d& point)
{
  check::finite(point, "joint position");
  Eigen::Matrix<double, 11, 1> numbers = Eigen::Matrix<double, 11, 1>::Zero();
  numbers.head<3>() = point;
  add_constraint(static_cast<int>(ConstraintRecord::Kind::ball), body1.body(), &body2.body(), {numbers.data(), 11});
}

int WorldHandle::add_constraint_to_world(long kind, const BodyNodeHandle& body, const VectorIn& numbers)
{
  return add_constraint(kind, body.body(), nullptr, numbers);
}

int WorldHandle::add_constraint_between(
    long kind, const BodyNodeHandle& body1, const BodyNodeHandle& body2, const VectorIn& numbers)
{
  return add_constraint(kind, body1.body(), &body2.body(), numbers);
}

int WorldHandle::add_constraint(
    long kind, dart::dynamics::BodyNode& a, dart::dynamics::BodyNode* b, const VectorIn& numbers)
{
  auto& record = world();
  check::size(numbers.size, 11, "numbers of a constraint");
  check::finite(numbers, "the places and lengths of a constraint");
  if (record.index_of(a.getSkeleton()) < 0 || (b && record.index_of(b->getSkeleton()) < 0))
    throw Error(Kind::value, "both bodies of a constraint must be in the world that it is added to");
  if (&a == b)
    throw Error(Kind::value, "a constraint needs two different bodies, got '" + a.getName() + "' twice");
  const Eigen::Map<const Eigen::VectorXd> values(numbers.data, 11);
  ConstraintRecord added;
  added.kind = static_cast<ConstraintRecord::Kind>(check::index(kind, ConstraintRecord::num_kinds, "kind of constraint"));
  if (added.kind == ConstraintRecord::Kind::revolute) {
    check::direction(values.segment<3>(3), "the axis of a constraint");
    added.axis = values.segment<3>(3).stableNormalized();
  }
  check::not_negative(values[9], "the length of a constraint");
  added.id = ++record.last_constraint;
  added.body1 = &a;
  added.body2 = b;
  added.point = values.head<3>();
  added.point2 = values.segment<3>(6);
  added.length = values[9];
  added.rope = values[10] != 0.0;
  wake_held(record, added);
  pydart2::add(added, *record.world->getConstraintSolver());
  record.constraints.push_back(added);
  return added.id;
}

void WorldHandle::constraint(long index, Output& out) const
{
  const auto& record = world();
  const auto& one = record.constraints[check::index(index, record.constraints.size(), "constraint")];
  const auto body = [](const dart::dynamics::BodyNode* b) { return b ? double(b->getIndexInSkeleton()) : -1.0; };
  vector(out, 17) << double(one.id), double(one.kind), double(record.index_of(one.skeleton1)), body(one.body1),
      one.skeleton2 ? double(record.index_of(one.skeleton2)) : -1.0, body(one.body2), one.point, one.axis,
      one.point2, one.length, double(one.rope);
}

ConstraintRecord& WorldHandle::constraint_of(long id) const
{
  for (auto& one : world().constraints)
    if (one.id == id)
      return one;
  throw Error(Kind::destroyed, "this constraint was removed from its world, or a body that it held was");
}

bool WorldHandle::constraint_is_enabled(long id) const
{
  return constraint_of(id).enabled;
}

void WorldHandle::set_constraint_enabled(long id, bool on)
{
  auto& one = constraint_of(id);
  wake_held(world(), one);
  enable(one, *world().world->getConstraintSolver(), on);
}

void WorldHandle::set_constraint_target(long id, const Eigen::Matrix4d& target)
{
  auto& one = constraint_of(id);
  if (one.body2 != nullptr || one.kind == ConstraintRecord::Kind::revolute)
    throw Error(Kind::value, "only a ball joint or a weld between a body and the world has a target that can be moved");
  check::rigid(target, "the target of a constraint");
  wake_held(world(), one);
  set_target(one, Eigen::Isometry3d(target));
}

Vector6d WorldHandle::constraint_wrench(long id) const
{
  const auto& one = constraint_of(id);
  Vector6d wrench = Vector6d::Zero();
  if (one.enabled)
    for (const auto& part : one.parts)
      wrench += engine::impulse_on_first(*part) / world().world->getTimeStep();
  const Eigen::Matrix3d R = one.body1->getWorldTransform().linear();
  wrench << R * wrench.head<3>().eval(), R * wrench.tail<3>().eval();
  return wrench;
}

bool WorldHandle::remove_constraint(long id)
{
  auto& record = world();
  auto& all = record.constraints;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.id == id; });
  if (found == all.end())
    return false;
  wake_held(record, *found);
  remove(*found, *record.world->getConstraintSolver());
  all.erase(found);
  return true;
}

int WorldHandle::num_constraints() const
{
  return static_cast<int>(world().constraints.size());
}

void WorldHandle::remove_all_constraints()
{
  auto& record = to_change();
  record.world->getConstraintSolver()->removeAllConstraints();
  record.constraints.clear();
}

bool WorldHandle::is_recording() const
{
  return world().recording.enabled();
}

void WorldHandle::set_recording(bool enable)
{
  auto& record = world();
  if (enable == record.recording.enabled())
    return;
  record.recording.set_enabled(enable);
  if (enable)
    pydart2::record(record);
}

long WorldHandle::num_frames() const
{
  return world().recording.num_frames();
}

long WorldHandle::first_frame() const
{
  return world().recording.first_frame();
}

bool WorldHandle::set_frame(long index)
{
  auto& record = world();
  const Frame* frame = record.recording.find(index);
  if (frame == nullptr || frame->layout != record.layout)
    return false;
  // A skeleton that was added after this frame keeps its state.
  std::vector<double> states(static_cast<std::size_t>(num_states(record)));
  write_states(record, states.data());
  std::copy(frame->state, frame->contacts(), states.begin());
  read_states(record, states.data());
  return true;
}

void WorldHandle::frame_states(long index, Output& out) const
{
  const auto& frame = kept_frame(world(), index);
  std::copy(frame.state, frame.contacts(), out.vector(static_cast<long>(frame.num_states)));
}

void WorldHandle::recorded_times(Output& out) const
{
  const auto& recording = world().recording;
  const long first = recording.first_frame();
  auto times = vector(out, recording.num_frames() - first);
  for (long i = 0; i < times.size(); ++i)
    times[i] = recording.find(first + i)->time;
}

void WorldHandle::recorded_states(Output& out) const
{
  const auto& record = world();
  const long first = record.recording.first_frame();
  auto states = matrix(out, record.recording.num_frames() - first, num_states(record));
  states.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (long i = 0; i < states.rows(); ++i) {
    const Frame& frame = *record.recording.find(first + i);
    if (frame.layout == record.layout)
      std::copy(frame.state, frame.contacts(), states.row(i).data());
  }
}

void WorldHandle::frame_contacts(long index, Output& out) const
{
  const auto& frame = kept_frame(world(), index);
  double* rows = out.matrix(static_cast<long>(frame.num_contacts), contact_columns);
  std::copy(frame.contacts(), frame.contacts() + frame.num_contacts * contact_columns, rows);
}

void WorldHandle::clear_recording()
{
  auto& record = world();
  record.recording.clear();
  pydart2::record(record);
}

void WorldHandle::record_frame()
{
  record(world());
}

long WorldHandle::recording_bytes() const
{
  return static_cast<long>(world().recording.bytes());
}

long WorldHandle::recording_limit() const
{
  return static_cast<long>(world().recording.limit());
}

void WorldHandle::set_recording_limit(long bytes)
{
  if (bytes < 0)
    throw Error(Kind::value, "the recording limit must be zero or more bytes, got " + std::to_string(bytes));
  world().recording.set_limit(static_cast<std::size_t>(bytes));
}

} // namespace pydart2
