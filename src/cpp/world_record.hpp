#pragma once

#include <atomic>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "recording.hpp"

namespace pydart2 {

class StateWatch; // stepping.cpp

/// A skeleton of a world, shared by all handles into it.
struct SkeletonRecord
{
  dart::dynamics::SkeletonPtr skeleton;

  /// Counts changes of the tree: a handle to a body, joint or dof made before the last one is refused.
  int structure = 0;

  std::shared_ptr<StateWatch> watch = nullptr;
};
using SkeletonRef = std::shared_ptr<SkeletonRecord>;

/// A constraint between bodies, with the skeletons that it needs alive.
struct ConstraintRecord
{
  dart::constraint::ConstraintBasePtr constraint;
  dart::dynamics::SkeletonPtr skeleton1, skeleton2;
};

/// A world and what belongs to it, shared by all handles into it.
struct WorldRecord
{
  /// busy: a call that released the interpreter lock is inside the engine.
  enum class State { ready, busy, destroyed };

  WorldRecord(int id, dart::simulation::WorldPtr world);

  /// Throws unless this world may be used now.
  void check() const
  {
    const State seen = state.load(std::memory_order_acquire);
    if (seen != State::ready)
      refuse(seen);
  }

  /// Changes when skeletons are removed or get another tree, so that the states of an earlier frame no longer fit.
  int layout() const;

  /// Throws what a state other than ready means.
  [[noreturn]] void refuse(State seen) const;

  /// Index of a skeleton in this world, -1 if it is not in it.
  int index_of(const dart::dynamics::ConstSkeletonPtr& skeleton) const;

  const int id;
  dart::simulation::WorldPtr world;
  std::vector<SkeletonRef> skeletons;
  std::vector<ConstraintRecord> constraints;
  std::vector<std::pair<dart::dynamics::BodyNode*, dart::dynamics::BodyNode*>> ignored_pairs;
  std::atomic<State> state{State::ready};
  long frame = 0; ///< Steps since the last reset.
  int removals = 0; ///< Skeletons that were removed, and the changes of their trees.
  Recording recording;

};
using WorldRef = std::shared_ptr<WorldRecord>;

/// Marks a world busy for the time of a long call, so that a second thread is refused instead of racing.
class Busy
{
public:
  explicit Busy(WorldRecord& world);
  ~Busy() { world_.state.store(after_, std::memory_order_release); }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

  /// The world is destroyed when this call ends.
  void destroy() { after_ = WorldRecord::State::destroyed; }

private:
  WorldRecord& world_;
  WorldRecord::State after_ = WorldRecord::State::ready;
};

} // namespace pydart2
