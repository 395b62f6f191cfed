#include "handles/batch.hpp"

#include <algorithm>
#include <atomic>
#include <dart/constraint/ConstraintSolver.hpp>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "base/interrupt.hpp"
#include "base/parallel.hpp"
#include "state/stepping.hpp"
#include "state/state_vector.hpp"

namespace pydart2 {

namespace {

/// Ends the work of a world where another's was interrupted.
struct Stop
{
};

/// Whether two worlds have as many dofs in each of as many skeletons.
bool alike(const WorldRecord& a, const WorldRecord& b)
{
  return std::equal(
      a.skeletons.begin(), a.skeletons.end(), b.skeletons.begin(), b.skeletons.end(),
      [](const SkeletonRef& s, const SkeletonRef& t) { return s->skeleton->getNumDofs() == t->skeleton->getNumDofs(); });
}

/// The engine's ODE detector shares memory between worlds.
void check_detector(const WorldRecord& world, std::size_t num_threads)
{
  if (num_threads > 1 && world.world->getConstraintSolver()->getCollisionDetector()->getType() == "ode")
    throw Error(
        Kind::value,
        "the ODE collision detector cannot run in several threads; use another detector, or a batch with threads=1");
}

using Row = Eigen::Map<const Eigen::VectorXd>;

/// Sets the forces of a skeleton, which wakes it unless they are zero.
void push(WorldRecord& world, SkeletonRecord& item, const Row& forces)
{
  if (!forces.isZero(0.0))
    world.about_to_change(item);
  item.skeleton->setForces(forces);
}

} // namespace

BatchHandle::BatchHandle(long num_threads) : num_threads_(static_cast<std::size_t>(num_threads))
{
  if (num_threads < 1)
    throw Error(Kind::value, "a batch needs one thread or more, got " + std::to_string(num_threads));
}

void BatchHandle::add(const WorldHandle& world)
{
  auto& record = world.ref();
  check_detector(*record, num_threads_);
  worlds_.push_back(record);
  errors_.emplace_back();
}

void BatchHandle::check_alike() const
{
  for (std::size_t i = 1; i < worlds_.size(); ++i)
    if (!alike(*worlds_[0], *worlds_[i]))
      throw Error(
          Kind::value,
          "world " + std::to_string(i) + " of the batch no longer has the skeletons and dofs of world 0; make a new Batch of "
              "a world that is as you want them all");
}

void BatchHandle::check_worlds() const
{
  for (const auto& world : worlds_)
    world->check();
  check_alike();
}

std::deque<Busy> BatchHandle::claim() const
{
  std::deque<Busy> claims; // all or none
  for (const auto& world : worlds_) {
    claims.emplace_back(*world); // refuses one that was destroyed
    check_detector(*world, num_threads_);
  }
  return claims;
}

/// Runs work(world, index, step) for the worlds that have not failed, where step() is one of that world. What the engine
/// throws becomes the world's error; when the user interrupts, all stop after the step that they are in.
template <class Work>
void BatchHandle::each_world(Work work)
{
  std::atomic<bool> interrupted{false};
  parallel_for(worlds_.size(), num_threads_, [&](std::size_t i) {
    if (interrupted || has_failed(i))
      return;
    const auto step = [&] {
      if (interrupted)
        throw Stop();
      advance(*worlds_[i]);
      Interruptible::poll();
    };
    try {
      work(*worlds_[i], i, step);
    } catch (const Error& error) {
      set_error(static_cast<long>(i), error.what());
    } catch (const Stop&) {
    } catch (...) {
      interrupted = true;
      throw;
    }
  });
}

void BatchHandle::step(long count)
{
  check::not_negative(static_cast<double>(count), "the number of steps");
  each_world([count](WorldRecord&, std::size_t, const auto& step) {
    for (long i = 0; i < count; ++i)
      step();
  });
}

void BatchHandle::rollout(long skeleton, const MatrixIn& actions, long hold, const MatrixOut& trajectories)
{
  check::positive(static_cast<double>(hold), "the number of steps of an action");
  check::finite(VectorIn{actions.data, actions.rows * actions.cols}, "actions");
  if (worlds_.empty())
    return;
  check_alike();
  const auto& skeletons = worlds_.front()->skeletons;
  const auto chosen = check::index(skeleton, skeletons.size(), "skeleton");
  const auto num_dofs = static_cast<long>(skeletons[chosen]->dofs().size()), size = num_states();
  const long times = size == 0 ? 0 : trajectories.cols / size;
  check::shape(actions, worlds_.size(), static_cast<std::size_t>(times * num_dofs), "actions");
  check::shape({trajectories.data, trajectories.rows, trajectories.cols}, worlds_.size(),
               static_cast<std::size_t>(times * size), "trajectories");
  each_world([&](WorldRecord& world, std::size_t i, const auto& step) {
    const double* action = actions.data + static_cast<long>(i) * actions.cols;
    double* row = trajectories.data + static_cast<long>(i) * trajectories.cols;
    for (long t = 0; t < times; ++t, action += num_dofs, row += size) {
      for (long k = 0; k < hold; ++k) {
        push(world, *world.skeletons[chosen], Row(action, num_dofs));
        step();
      }
      write_states(world, row);
    }
  });
}

SkeletonRecord& BatchHandle::skeleton(std::size_t world, long index) const
{
  const auto& skeletons = worlds_[world]->skeletons;
  return *skeletons[check::index(index, skeletons.size(), "skeleton")];
}

long BatchHandle::num_states() const
{
  return worlds_.empty() ? 0 : pydart2::num_states(*worlds_.front());
}

void BatchHandle::states(Output& into) const
{
  check_worlds();
  double* row = into.matrix(num_worlds(), num_states());
  for (const auto& world : worlds_) {
    write_states(*world, row);
    row += num_states();
  }
}

void BatchHandle::set_states(const MatrixIn& states)
{
  check_worlds();
  check::shape(states, worlds_.size(), static_cast<std::size_t>(num_states()), "states");
  check::finite(VectorIn{states.data, states.rows * states.cols}, "states");
  for (std::size_t i = 0; i < worlds_.size(); ++i)
    read_states(*worlds_[i], states.data + static_cast<long>(i) * states.cols);
}

template <class Places>
void BatchHandle::gather(long skeleton, Places places, Output& into) const
{
  check_worlds();
  const auto cols = worlds_.empty() ? 0 : static_cast<long>(this->skeleton(0, skeleton).dofs().size());
  double* value = into.matrix(num_worlds(), cols);
  for (std::size_t i = 0; i < worlds_.size(); ++i)
    for (const double* place : this->skeleton(i, skeleton).dofs().*places)
      *value++ = *place;
}

void BatchHandle::positions(long skeleton, Output& into) const
{
  gather(skeleton, &DofState::positions, into);
}

void BatchHandle::velocities(long skeleton, Output& into) const
{
  gather(skeleton, &DofState::velocities, into);
}

template <class Set>
void BatchHandle::set_rows(long skeleton, const MatrixIn& rows, const char* what, Set set)
{
  check_worlds();
  const auto cols = worlds_.empty() ? 0 : this->skeleton(0, skeleton).dofs().size();
  check::shape(rows, worlds_.size(), cols, what);
  check::finite(VectorIn{rows.data, rows.rows * rows.cols}, what);
  for (std::size_t i = 0; i < worlds_.size(); ++i)
  {
    const Row row(rows.data + static_cast<long>(i) * rows.cols, rows.cols);
    set(*worlds_[i], this->skeleton(i, skeleton), row);
  }
}

void BatchHandle::set_positions(long skeleton, const MatrixIn& positions)
{
  set_rows(skeleton, positions, "positions", [](auto& world, auto& item, const auto& q) {
    world.about_to_change(item);
    item.skeleton->setPositions(q);
  });
}

void BatchHandle::set_velocities(long skeleton, const MatrixIn& velocities)
{
  set_rows(skeleton, velocities, "velocities", [](auto& world, auto& item, const auto& dq) {
    world.about_to_change(item);
    item.skeleton->setVelocities(dq);
  });
}

void BatchHandle::set_forces(long skeleton, const MatrixIn& forces)
{
  set_rows(skeleton, forces, "forces", push);
}

std::vector<std::string> BatchHandle::errors() const
{
  const std::lock_guard<std::mutex> lock(errors_mutex_);
  return errors_;
}

bool BatchHandle::has_failed(std::size_t world) const
{
  const std::lock_guard<std::mutex> lock(errors_mutex_);
  return !errors_[world].empty();
}

void BatchHandle::set_error(long world, const std::string& error)
{
  const std::lock_guard<std::mutex> lock(errors_mutex_);
  errors_[check::index(world, worlds_.size(), "world")] = error;
}

} // namespace pydart2
