#include "state/world_record.hpp"

#include <algorithm>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/constraint/ConstraintSolver.hpp>

#include "base/errors.hpp"
#include "collision/detector.hpp"
#include "contact/fast_solver.hpp"
#include "dynamics/tree_dynamics.hpp"
#include "engine/tree_members.hpp"
#include "state/contact.hpp"
#include "state/sleeping.hpp"
#include "state/state_vector.hpp"

namespace pydart2 {

const DofState& SkeletonRecord::dofs()
{
  if (not_numbers)
    return *not_numbers;
  if (!found_dofs || found_structure != structure) {
    found_dofs.emplace(*skeleton);
    found_structure = structure;
  }
  return *found_dofs;
}

Eigen::VectorXd& SkeletonRecord::last_forces()
{
  if (std::exchange(last_forces_structure, structure) != structure)
    remembered_forces = skeleton->getForces();
  return remembered_forces;
}

void WorldRecord::become_not_numbers(SkeletonRecord& skeleton)
{
  skeleton.not_numbers.emplace(*skeleton.skeleton);
  skeleton.not_numbers->become_not_numbers();
  blown_up = true;
  plan.note_change();
}

void WorldRecord::become_numbers(SkeletonRecord& skeleton)
{
  skeleton.not_numbers.reset();
  blown_up = std::any_of(skeletons.begin(), skeletons.end(), [](const auto& item) { return item->not_numbers.has_value(); });
}

void WorldRecord::become_numbers()
{
  for (const auto& item : skeletons)
    item->not_numbers.reset();
  blown_up = false;
}

TreeDynamics* SkeletonRecord::dynamics()
{
  if (dynamics_structure != structure) {
    made_dynamics = TreeDynamics::of(*skeleton);
    dynamics_structure = structure;
  }
  return made_dynamics.get();
}

SkeletonRecord::Passes& SkeletonRecord::passes()
{
  if (std::exchange(passes_structure, structure) != structure)
    made_passes.emplace(Passes{LinkTree(*skeleton), {}, {}});
  return *made_passes;
}

SkeletonIntegrator& SkeletonRecord::integrator()
{
  if (integrator_structure != structure) {
    made_integrator.emplace(*skeleton);
    integrator_structure = structure;
  }
  return *made_integrator;
}

WorldRecord::WorldRecord(int id, dart::simulation::WorldPtr world, std::string source)
  : id(id), world(std::move(world)), source(std::move(source))
{
  replace_detector(*this->world->getConstraintSolver());
  install_solver(*this->world, default_solver());
  apply_collision_filter(*this);
  for (std::size_t i = 0; i < this->world->getNumSkeletons(); ++i)
    skeletons.push_back(std::make_shared<SkeletonRecord>(SkeletonRecord{this->world->getSkeleton(i), {}, false, false, static_cast<int>(i)}));
}

void WorldRecord::clear()
{
  const auto lock = lock_ode();
  recording.set_enabled(false);
  constraints.clear();
  ignored_pairs.clear();
  collision_bits.clear();
  sleep = {};
  plan = {};
  skeletons.clear();
  world.reset();
}

void WorldRecord::record_frame()
{
  const auto& frame = recording.add(
      static_cast<std::size_t>(num_states(*this)), num_contacts(*this), sleep.asleep.size(), layout, world->getTime());
  write_states(*this, frame.state);
  write_contacts(*this, frame.contacts());
  double* sleeper = frame.sleepers();
  for (std::size_t i = 0; i < skeletons.size() && frame.num_sleepers > 0; ++i)
    if (skeletons[i]->island != 0)
      *sleeper++ = double(i);
  for (const auto& skeleton : skeletons)
    skeleton->recorded = true;
}

void WorldRecord::add(const dart::dynamics::SkeletonPtr& skeleton, const std::string& source)
{
  const auto lock = lock_ode();
  skeleton->setName(free_name(skeleton->getName()));
  world->addSkeleton(skeleton);
  skeletons.push_back(std::make_shared<SkeletonRecord>(SkeletonRecord{skeleton, source, false, source.empty()}));
  ++changes;
  plan.note_change();
  if (sleep.enabled) {
    sleep.awake.push_back(skeletons.back());
    sleep.awake_skeletons.push_back(skeleton);
  }
}

void WorldRecord::about_to_change(SkeletonRecord& skeleton)
{
  ++changes;
  skeleton.shapes_reach.reset();
  plan.note_change(skeleton);
  if (sleep.enabled)
    wake(*this, skeleton);
}

std::string WorldRecord::free_name(const std::string& name)
{
  if (!world->hasSkeleton(name))
    return name;
  std::string numbered;
  int& number = last_numbers_[name]; // the engine counts from 1 for each
  do
    numbered = name + " (" + std::to_string(++number) + ")";
  while (world->hasSkeleton(numbered));
  return numbered;
}

void WorldRecord::tree_changed(SkeletonRecord& skeleton)
{
  ++skeleton.structure;
  ++changes;
  auto& changed = *skeleton.skeleton; // where a tree has gone the engine has matrices of zeros, and takes them for known
  engine::SkeletonMembers::all(changed) = {};
  for (std::size_t i = 0; i < changed.getNumTrees(); ++i)
    engine::SkeletonMembers::tree(changed, i) = {};
  skeleton.shapes_reach.reset();
  plan.note_change();
  skeleton.limits_checked = false;
  if (skeleton.recorded)
    ++layout;
}

int WorldRecord::index_of(const dart::dynamics::ConstSkeletonPtr& skeleton) const
{
  for (std::size_t i = 0; i < skeletons.size(); ++i)
    if (skeletons[i]->skeleton == skeleton)
      return static_cast<int>(i);
  return -1;
}

void WorldRecord::refuse(State seen) const
{
  const std::string name = "world " + std::to_string(id);
  if (seen == State::busy)
    throw Error(Kind::engine, name + " is in use by another thread; give each thread a world of its own");
  throw Error(Kind::destroyed, name + " was destroyed by destroy() or by a later init(); make a new World");
}

void apply_collision_filter(WorldRecord& world)
{
  const auto filter = std::make_shared<engine::BodyFilter>(world.collision_bits);
  for (const auto& [body1, body2] : world.ignored_pairs)
    filter->addBodyNodePairToBlackList(body1, body2);
  world.world->getConstraintSolver()->getCollisionOption().collisionFilter = filter;
}

bool passes_through(const WorldRecord& world, const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b)
{
  const auto& filter = world.world->getConstraintSolver()->getCollisionOption().collisionFilter;
  return engine::PairFilter(filter.get()).is_told_to_ignore(a, b);
}

void forget_in_filter(WorldRecord& world, const std::set<const dart::dynamics::BodyNode*>& gone)
{
  auto& pairs = world.ignored_pairs;
  const auto has_gone = [&](const auto& pair) { return gone.count(pair.first) + gone.count(pair.second) != 0; };
  const auto kept = std::remove_if(pairs.begin(), pairs.end(), has_gone);
  bool any = kept != pairs.end();
  pairs.erase(kept, pairs.end());
  for (const auto* body : gone)
    any |= world.collision_bits.erase(body) != 0;
  if (any)
    apply_collision_filter(world);
}

Busy::Busy(WorldRecord& world) : world_(world)
{
  auto expected = WorldRecord::State::ready;
  if (!world.state.compare_exchange_strong(expected, WorldRecord::State::busy))
    world.refuse(expected); // not world.check(): the other thread may be done by now
}

} // namespace pydart2
