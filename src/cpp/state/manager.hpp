#pragma once

#include <map>
#include <string>

#include "base/fork.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

/// World id -> world. Handles own their worlds; the manager gives ids and can end all worlds at once.
class Manager
{
public:
  static Manager& instance();

  /// `source`: what it was loaded from (clone.hpp).
  WorldRef add(dart::simulation::WorldPtr world, std::string source = {});

  /// The world of an id; throws if there is none.
  WorldRef find(long id);

  /// Ends one world: every later use of a handle into it throws.
  void destroy(WorldRecord& world);

  /// Ends all worlds and starts ids at 0 again; all or, where another thread is using one, none.
  void restart();

private:
  HeldOverFork<std::mutex> mutex_{ForkOrder::manager};
  std::map<long, std::weak_ptr<WorldRecord>> worlds_;
  int next_id_ = 0;
};

} // namespace pydart2
