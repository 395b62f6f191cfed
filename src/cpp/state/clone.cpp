#include "state/clone.hpp"

#include <algorithm>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "base/errors.hpp"
#include "collision/detector.hpp"
#include "loading/built.hpp"
#include "loading/loading.hpp"
#include "loading/root_joint.hpp"
#include "loading/skeleton_copy.hpp"
#include "state/manager.hpp"
#include "state/model_archive.hpp"
#include "state/snapshot.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::SkeletonPtr;
using dart::simulation::WorldPtr;

ModelSource unpacked(const std::string& source)
{
  std::istringstream in(source);
  return unpack_source(in);
}

WorldPtr world_from(const std::string& source)
{
  if (source.empty())
    return dart::simulation::World::create();
  return load_world(unpacked(source));
}

std::string source_of(const SkeletonRecord& record)
{
  if (!record.built)
    return record.source;
  ModelSource source("built", "");
  source.add_text("", built::structure_of(*record.skeleton));
  return source.packed();
}

/// The plan: the world's source, its detector, and for each skeleton its source, its index in the world that it came
/// with, its root changes.
constexpr std::size_t texts_of_world = 2, texts_per_skeleton = 3;
constexpr char letter_of[] = "ewf"; // RootChange

std::vector<std::string> plan_of(const WorldRecord& world)
{
  std::vector<std::string> plan{world.source, world.world->getConstraintSolver()->getCollisionDetector()->getType()};
  for (const auto& item : world.skeletons) {
    std::string changes;
    for (const auto change : item->root_changes)
      changes += letter_of[static_cast<int>(change)];
    plan.insert(plan.end(), {source_of(*item), std::to_string(item->index_in_source), changes});
  }
  return plan;
}

/// Takes away what came with the world and is not in the plan.
void remove_others(WorldRecord& world, const std::vector<std::string>& plan)
{
  const auto lock = lock_ode();
  for (auto item = world.skeletons.begin(); item != world.skeletons.end();) {
    bool wanted = false;
    for (std::size_t i = texts_of_world; i < plan.size(); i += texts_per_skeleton)
      wanted |= plan[i].empty() && plan[i + 1] == std::to_string((*item)->index_in_source);
    if (!wanted)
      world.world->removeSkeleton((*item)->skeleton);
    item = wanted ? item + 1 : world.skeletons.erase(item);
  }
}

/// Whether one that came with the world comes after one that did not, as a skeleton does that was changed.
bool has_own_after_others(const std::vector<std::string>& plan)
{
  bool others = false;
  for (std::size_t i = texts_of_world; i < plan.size(); i += texts_per_skeleton) {
    if (others && plan[i].empty())
      return true;
    others |= !plan[i].empty();
  }
  return false;
}

std::vector<SkeletonRef> take_out(WorldRecord& world)
{
  const auto lock = lock_ode();
  auto skeletons = std::move(world.skeletons);
  world.skeletons.clear();
  for (const auto& item : skeletons)
    world.world->removeSkeleton(item->skeleton);
  world.shapes_changed = true;
  return skeletons;
}

void add_again(WorldRecord& world, const SkeletonRef& record)
{
  const auto lock = lock_ode();
  world.world->addSkeleton(record->skeleton);
  world.skeletons.push_back(record);
}

bool alike(const SkeletonPtr& one, const SkeletonPtr& two)
{
  Archive archives[2];
  SkeletonRecord records[] = {{one}, {two}};
  for (const int i : {0, 1})
    visit_skeleton(archives[i], records[i]);
  return archives[0].texts == archives[1].texts && archives[0].numbers == archives[1].numbers;
}

/// What makes the skeletons of a plan, and reads each source once.
class Loader
{
public:
  explicit Loader(const std::vector<std::string>& plan)
  {
    for (std::size_t i = texts_of_world; i < plan.size(); i += texts_per_skeleton)
      ++sources_[plan[i]].wanted;
  }

  void add_to(WorldRecord& world, const std::string& source)
  {
    auto& known = sources_[source];
    if (known.first == nullptr) {
      const auto model = unpacked(source);
      known.first = load_skeleton(model);
      known.built = model.kind() == "built";
    }
    world.add(take(known), known.built ? std::string() : source);
  }

private:
  struct Source
  {
    int wanted = 0; ///< So many times more.
    SkeletonPtr first; ///< As it was loaded.
    bool built = false;
    bool copied = false; ///< Once, and the copy was like it.
  };

  static SkeletonPtr take(Source& source)
  {
    if (--source.wanted > 0)
      if (auto copy = copy_of(*source.first); copy != nullptr && (source.copied || alike(source.first, copy))) {
        source.copied = true;
        return copy;
      }
    return std::exchange(source.first, nullptr);
  }

  std::unordered_map<std::string, Source> sources_;
};

void change_root(WorldRecord& world, SkeletonRecord& record, char change)
{
  constexpr decltype(&change_root_to_weld) changes[] = {change_root_to_trans_and_euler, change_root_to_weld, change_root_to_free};
  const std::size_t which = std::string(letter_of).find(change);
  if (which == std::string::npos)
    Archive::refuse();
  changes[which](*record.skeleton);
  note_root_change(world, record, static_cast<RootChange>(which));
}

void follow_plan(WorldRecord& world, const std::vector<std::string>& plan)
{
  remove_others(world, plan);
  auto& solver = *world.world->getConstraintSolver();
  if (plan[1] != solver.getCollisionDetector()->getType())
    use_detector(solver, make_detector(plan[1])); // before there is anything that another one makes trees of
  place_at_once(solver, true);
  auto own = has_own_after_others(plan) ? take_out(world) : std::vector<SkeletonRef>();
  Loader loader(plan);
  std::size_t index = 0;
  for (std::size_t i = texts_of_world; i < plan.size(); i += texts_per_skeleton, ++index) {
    if (!plan[i].empty())
      loader.add_to(world, plan[i]);
    else if (!own.empty()) {
      add_again(world, own.front());
      own.erase(own.begin());
    }
    if (index >= world.skeletons.size())
      Archive::refuse();
    for (const char change : plan[i + 2])
      change_root(world, *world.skeletons[index], change);
  }
}

} // namespace

void mark_built(WorldRecord& world, SkeletonRecord& record)
{
  if (!record.built)
    built::structure_of(*record.skeleton);
  world.shapes_changed = true;
  record.built = true;
  record.root_changes.clear();
}

void note_root_change(WorldRecord& world, SkeletonRecord& record, RootChange change)
{
  if (!record.built)
    record.root_changes.push_back(change);
  if (record.skeleton->getNumTrees() > 1)
    world.shapes_changed = true;
}

Blueprint blueprint_of(WorldRecord& world)
{
  Archive model;
  visit_model(model, world);
  return {plan_of(world), model.texts, model.numbers, state_of(world)};
}

WorldRef build(const Blueprint& blueprint)
{
  const auto& plan = blueprint.plan;
  if (plan.size() < texts_of_world || (plan.size() - texts_of_world) % texts_per_skeleton != 0)
    Archive::refuse();
  const auto world = Manager::instance().add(world_from(plan[0]), plan[0]);
  const Busy claim(*world); // another thread's init() would clear it
  follow_plan(*world, plan);
  if (const Eigen::Map<const Eigen::VectorXd> numbers(blueprint.numbers.data(), static_cast<long>(blueprint.numbers.size()));
      numbers.hasNaN())
    Archive::refuse();
  for (const auto& item : world->skeletons) // none of the names to come is another's
    item->skeleton->setName("\n" + item->skeleton->getName());
  Archive model(blueprint.texts, blueprint.numbers);
  visit_model(model, *world);
  model.finish();
  place_at_once(*world->world->getConstraintSolver(), false);
  restore_state(*world, blueprint.state); // makes the detector's tree anew
  const auto made = blueprint_of(*world);
  auto state = blueprint.state;
  state.resize(std::max(state.size(), made.state.size()), 0.0); // one from before there were motors has none
  if (made.texts != blueprint.texts || made.numbers != blueprint.numbers || made.state != state)
    throw Error(Kind::engine, "the world cannot be made again: the engine does not take some of its numbers back");
  return world;
}

} // namespace pydart2
