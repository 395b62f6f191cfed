#include "state/held_groups.hpp"

#include <algorithm>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <unordered_map>

#include "dynamics/held_motion.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::Skeleton;

constexpr double closed = 1e-4; ///< m

struct Group
{
  std::vector<HeldMotion::Member> members;
  std::vector<Tie> ties;
  bool alone = true; ///< Nothing but the ties has acted.
};

const Skeleton* skeleton_of(const dart::collision::CollisionObject& object)
{
  const auto* node = object.getShapeFrame()->asShapeNode();
  return node == nullptr ? nullptr : node->getBodyNodePtr()->getSkeleton().get();
}

std::unordered_set<const Skeleton*> pushed(const WorldRecord& record)
{
  std::unordered_set<const Skeleton*> found;
  for (const auto& contact : record.world->getConstraintSolver()->getLastCollisionResult().getContacts())
    if (!contact.force.isZero(0.0)) {
      found.insert(skeleton_of(*contact.collisionObject1));
      found.insert(skeleton_of(*contact.collisionObject2));
    }
  return found;
}

/// The groups that constraints make of the skeletons, in the order of these.
std::vector<Group> groups(const WorldRecord& record)
{
  std::unordered_map<const Skeleton*, const Skeleton*> parents;
  const auto root = [&](const Skeleton* one) {
    while (parents.at(one) != one)
      one = parents.at(one);
    return one;
  };
  for (const auto& constraint : record.constraints)
    if (constraint.enabled)
      for (const auto& skeleton : {constraint.skeleton1, constraint.skeleton2})
        if (skeleton != nullptr && skeleton->isMobile() && skeleton->getNumDofs() > 0)
          parents.emplace(skeleton.get(), skeleton.get());
  for (const auto& constraint : record.constraints)
    if (constraint.enabled && parents.count(constraint.skeleton1.get()) && parents.count(constraint.skeleton2.get()))
      parents[root(constraint.skeleton2.get())] = root(constraint.skeleton1.get());

  std::vector<Group> found;
  std::unordered_map<const Skeleton*, std::size_t> numbers;
  const auto touched = pushed(record);
  for (const auto& item : record.awake()) {
    auto* skeleton = item->skeleton.get();
    if (!parents.count(skeleton))
      continue;
    const auto [place, is_new] = numbers.emplace(root(skeleton), found.size());
    if (is_new)
      found.emplace_back();
    auto& group = found[place->second];
    group.alone &= skeleton->getNumSoftBodyNodes() == 0 && !touched.count(skeleton) && item->integrator().joints_are_free();
    group.members.push_back({skeleton, &item->integrator(), &item->armature});
  }
  for (const auto& constraint : record.constraints)
    for (const auto* skeleton : {constraint.skeleton1.get(), constraint.skeleton2.get()})
      if (const auto place = parents.count(skeleton) ? numbers.find(root(skeleton)) : numbers.end();
          constraint.enabled && place != numbers.end()) {
        auto& group = found[place->second];
        group.alone &= !constraint.rope;
        group.ties.insert(group.ties.end(), constraint.ties.begin(), constraint.ties.end());
        break; // both are of one group, or the other cannot move
      }
  return found;
}

} // namespace

std::unordered_set<const Skeleton*> move_held_groups(const WorldRecord& record, double dt)
{
  std::unordered_set<const Skeleton*> moved;
  if (record.integrator != Integrator::rk4 || record.constraints.empty())
    return moved;
  for (auto& group : groups(record)) {
    const auto members = group.members;
    HeldMotion motion(std::move(group.members), std::move(group.ties));
    if (!group.alone || motion.error() > closed)
      continue;
    motion.step_rk4(dt);
    for (const auto& member : members)
      moved.insert(member.skeleton);
  }
  return moved;
}

} // namespace pydart2
