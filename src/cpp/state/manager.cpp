#include "state/manager.hpp"

#include <list>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace pydart2 {

namespace {

/// A world that is about to end; refuses one that another thread is stepping.
class Ending
{
public:
  explicit Ending(WorldRecord& world) : world_(world), claim_(world) {}

  void end()
  {
    claim_.destroy();
    world_.clear();
  }

private:
  WorldRecord& world_;
  Busy claim_;
};

Manager manager;

} // namespace

Manager& Manager::instance()
{
  return manager;
}

WorldRef Manager::add(dart::simulation::WorldPtr world, std::string source)
{
  const std::lock_guard lock(mutex_);
  auto record = std::make_shared<WorldRecord>(next_id_++, std::move(world), std::move(source));
  worlds_.emplace(record->id, record);
  for (auto it = worlds_.begin(); it != worlds_.end();)
    it = it->second.expired() ? worlds_.erase(it) : std::next(it);
  return record;
}

WorldRef Manager::find(long id)
{
  const std::lock_guard lock(mutex_);
  if (const auto it = worlds_.find(id); it != worlds_.end())
    if (auto record = it->second.lock())
      return record;
  throw Error(Kind::index, "no world " + std::to_string(id) + ": none was made with this id, or it is gone");
}

void Manager::destroy(WorldRecord& world)
{
  const std::lock_guard lock(mutex_);
  Ending(world).end();
  worlds_.erase(world.id);
}

void Manager::restart()
{
  const std::lock_guard lock(mutex_);
  std::vector<WorldRef> all;
  std::list<Ending> endings;
  for (auto& [id, world] : worlds_)
    if (const auto record = world.lock()) {
      all.push_back(record);
      endings.emplace_back(*record);
    }
  for (auto& ending : endings)
    ending.end();
  worlds_.clear();
  next_id_ = 0;
}

} // namespace pydart2
