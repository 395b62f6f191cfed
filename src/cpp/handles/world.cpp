#include "handles/world.hpp"

#include <algorithm>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/SoftBodyNode.hpp>
#include <limits>

#include "base/aside.hpp"
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
#include "state/snapshot.hpp"
#include "state/stepping.hpp"
#include "state/state_vector.hpp"

namespace pydart2 {

namespace {

dart::simulation::WorldPtr make_world(double time_step)
{
  check::positive(time_step, "time step");
  auto world = dart::simulation::World::create();
  world->setTimeStep(time_step);
  return world;
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

} // namespace

void restart()
{
  Manager::instance().restart();
  messages::forget();
}

WorldHandle::WorldHandle(WorldRef record) : record_(std::move(record)) {}

WorldHandle::WorldHandle(double time_step) : record_(Manager::instance().add(make_world(time_step))) {}

WorldHandle WorldHandle::load(const ModelSource& source, double seconds, bool is_quick)
{
  auto world = is_quick ? load_world(source) : aside(seconds, [source] { return load_world(source); });
  return WorldHandle(Manager::instance().add(std::move(world), source.packed()));
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

int WorldHandle::add_skeleton(const ModelSource& source, double seconds, bool is_quick)
{
  record_->add(
      is_quick ? load_skeleton(source) : aside(seconds, [source] { return load_skeleton(source); }), source.packed());
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
  record.recording.forget_sleeper(static_cast<int>(i));
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
      record_->record_frame();
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

int WorldHandle::num_contacts() const
{
  return static_cast<int>(pydart2::num_contacts(world()));
}

void WorldHandle::contacts(Output& out) const
{
  const auto& record = world();
  write_contacts(record, out.matrix(static_cast<long>(pydart2::num_contacts(record)), contact_columns));
}

} // namespace pydart2
