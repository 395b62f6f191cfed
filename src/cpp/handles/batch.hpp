#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "base/arrays.hpp"
#include "handles/world.hpp"

namespace pydart2 {

/// Many worlds with the same skeletons, stepped side by side. Arrays have one row per world. A world whose simulation
/// blows up stays as it was before that step and is left alone until its error is set to nothing; the others go on.
class BatchHandle
{
public:
  /// Worlds are handed out to this many threads one by one, so that what a world does depends on no other and not on
  /// the threads.
  explicit BatchHandle(long num_threads);

  /// Adds a world; arrays need all of them to have the same skeletons.
  void add(const WorldHandle& world);
  int num_worlds() const { return static_cast<int>(worlds_.size()); }
  int num_threads() const { return static_cast<int>(num_threads_); }

  /// All its worlds, for step() and rollout(), whose caller holds the claims.
  std::deque<Busy> claim() const;

  void step(long count);

  /// From the present states: the rows of `actions` hold the forces of a skeleton's dofs, time after time, each for
  /// `hold` steps. Writes the states [q, dq] of all skeletons after each action, time after time; nothing after a failure.
  void rollout(long skeleton, const MatrixIn& actions, long hold, const MatrixOut& trajectories);

  /// [q, dq] of each skeleton, one after another.
  void states(Output& into) const;
  void set_states(const MatrixIn& states);
  void positions(long skeleton, Output& into) const;
  void velocities(long skeleton, Output& into) const;
  void set_positions(long skeleton, const MatrixIn& positions);
  void set_velocities(long skeleton, const MatrixIn& velocities);
  void set_forces(long skeleton, const MatrixIn& forces);

  /// Why each world has stopped; empty for those that go on. Also while another thread steps the batch.
  std::vector<std::string> errors() const;
  void set_error(long world, const std::string& error);

private:
  template <class Work>
  void each_world(Work work);
  template <class Places>
  void gather(long skeleton, Places places, Output& into) const;
  template <class Set>
  void set_rows(long skeleton, const MatrixIn& rows, const char* what, Set set);
  SkeletonRecord& skeleton(std::size_t world, long index) const;
  long num_states() const;
  bool has_failed(std::size_t world) const;

  /// Throws unless all worlds may be used and are alike.
  void check_worlds() const;
  void check_alike() const;

  std::size_t num_threads_;
  std::vector<WorldRef> worlds_;
  std::vector<std::string> errors_;
  mutable std::mutex errors_mutex_;
};

} // namespace pydart2
