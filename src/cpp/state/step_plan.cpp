#include "state/step_plan.hpp"

#include <algorithm>
#include <utility>

#include "base/large_pages.hpp"
#include "collision/native_detector.hpp"
#include "contact/fast_solver.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

namespace {

/// Whether free bodies may be moved apart from the engine, whose bits the other solvers promise.
bool has_arrays(const WorldRecord& world)
{
  return world.dynamics == Dynamics::fast && world.integrator == Integrator::engine && fast_solver(*world.world).sweeps_all();
}

bool is_free(const WorldRecord& world, const SkeletonRecord& item)
{
  const auto holds = [&](const ConstraintRecord& constraint) {
    return constraint.skeleton1 == item.skeleton || constraint.skeleton2 == item.skeleton;
  };
  return !item.motors.targets() && item.armature.empty() && !item.not_numbers && FreeBodies::is_one(*item.skeleton)
         && std::none_of(world.constraints.begin(), world.constraints.end(), holds);
}

void find_kinds(const WorldRecord& world, StepPlan& plan)
{
  plan.rigid = std::none_of(world.skeletons.begin(), world.skeletons.end(), [](const auto& item) {
    return item->skeleton->getNumSoftBodyNodes() > 0;
  });
  plan.jointed.look_at(plan.other_skeletons);
}

void make_anew(WorldRecord& world)
{
  auto& plan = world.plan;
  plan.free.clear();
  plan.owners.clear();
  plan.others.clear();
  plan.other_skeletons.clear();
  const bool arrays = has_arrays(world);
  for (const auto& item : world.skeletons)
    item->free = -1;
  for (const auto& item : world.awake())
    if (arrays && is_free(world, *item)) {
      item->free = static_cast<int>(plan.owners.size());
      plan.free.add(*item->skeleton);
      plan.owners.push_back(item);
    } else {
      plan.others.push_back(item);
      plan.other_skeletons.push_back(item->skeleton);
    }
  plan.stale = false;
  use_large_pages();
}

} // namespace

void StepPlan::note_change(SkeletonRecord& skeleton)
{
  ++changes;
  if (!stale && std::exchange(skeleton.changed_in, round) != round)
    changed.push_back(&skeleton);
}

void StepPlan::note_change()
{
  ++changes;
  stale = true;
  changed.clear(); // of which some may be gone
}

StepPlan& make_plan(WorldRecord& world)
{
  auto& plan = world.plan;
  plan.same = !plan.stale && plan.changed.empty();
  ++plan.round;
  for (auto* item : plan.changed) {
    const bool free = item->free >= 0;
    if (free && is_free(world, *item))
      plan.free.read_model(static_cast<std::size_t>(item->free));
    else if (free || (item->island == 0 && is_free(world, *item)))
      plan.stale = true;
  }
  plan.changed.clear();
  plan.native = native_group(fast_solver(*world.world)) != nullptr;
  if (plan.stale)
    make_anew(world);
  if (!plan.same)
    find_kinds(world, plan);
  plan.begun = 0;
  return plan;
}

void plan_through_engine(WorldRecord& world)
{
  auto& plan = world.plan;
  const long round = plan.round, changes = plan.changes;
  plan = {};
  plan.round = round;
  plan.changes = changes + 1;
  plan.others = world.skeletons;
  for (const auto& item : world.skeletons)
    plan.other_skeletons.push_back(item->skeleton);
  find_kinds(world, plan);
}

} // namespace pydart2
