#pragma once

#include <atomic>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "state/constraint_record.hpp"
#include "state/dof_state.hpp"
#include "state/recording.hpp"

namespace pydart2 {

class StateWatch; // stepping.cpp

enum class RootChange { trans_and_euler, weld };

/// A skeleton of a world, shared by all handles into it, and where it came from.
struct SkeletonRecord
{
  dart::dynamics::SkeletonPtr skeleton;

  std::string source = {};    ///< ModelSource::packed() of what it was loaded from; empty if it came with the world.
  int index_in_source = -1;   ///< Where it was in the world that it came with.
  std::vector<RootChange> root_changes = {};

  /// Counts changes of the tree: a handle to a body, joint or dof made before the last one is refused.
  int structure = 0;

  std::shared_ptr<StateWatch> watch = nullptr;

  /// Where the engine keeps the state, found again when the tree has changed.
  const DofState& dofs();

  std::optional<DofState> found_dofs;
  int found_structure = 0;
};
using SkeletonRef = std::shared_ptr<SkeletonRecord>;

/// A world and what belongs to it, shared by all handles into it.
struct WorldRecord
{
  /// busy: a call that released the interpreter lock is inside the engine.
  enum class State { ready, busy, destroyed };

  WorldRecord(int id, dart::simulation::WorldPtr world, std::string source);
  ~WorldRecord() { clear(); }

  /// Frees what belongs to the world.
  void clear();

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

  /// Adds a skeleton that was loaded from `source`.
  void add(const dart::dynamics::SkeletonPtr& skeleton, const std::string& source);

  /// Index of a skeleton in this world, -1 if it is not in it.
  int index_of(const dart::dynamics::ConstSkeletonPtr& skeleton) const;

  const int id;
  dart::simulation::WorldPtr world;
  const std::string source; ///< ModelSource::packed() of what it was loaded from; empty if it was made empty.
  std::vector<SkeletonRef> skeletons;
  std::vector<ConstraintRecord> constraints;
  std::vector<std::pair<dart::dynamics::BodyNode*, dart::dynamics::BodyNode*>> ignored_pairs;
  std::atomic<State> state{State::ready};
  long frame = 0; ///< Steps since the last reset.
  int removals = 0; ///< Skeletons that were removed, and the changes of their trees.
  Recording recording;

};
using WorldRef = std::shared_ptr<WorldRecord>;

/// Fills the engine's filter, which holds bare pointers, anew from the record.
void apply_ignored_pairs(WorldRecord& world);

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
