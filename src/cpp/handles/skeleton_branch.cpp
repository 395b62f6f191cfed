// Branches that get another parent, and copies of them: a body with all that hangs from it.

#include <dart/constraint/ConstraintSolver.hpp>
#include <map>
#include <set>

#include "base/archive.hpp"
#include "base/checks.hpp"
#include "collision/detector.hpp"
#include "handles/skeleton.hpp"
#include "loading/built.hpp"
#include "state/clone.hpp"
#include "state/model_archive.hpp"

namespace pydart2 {

using dart::dynamics::BodyNode;
using dart::dynamics::Joint;

namespace {

/// A body and all that hangs from it, parents first.
class Branch
{
public:
  explicit Branch(BodyNode& first)
  {
    for (auto* body : first.getSkeleton()->getBodyNodes()) // parents come first
      if (body == &first || has(body->getParentBodyNode()))
        add(*body);
  }

  bool has(const BodyNode* body) const { return set_.count(body) != 0; }
  bool has(const Joint& joint) const { return has(joint.getChildBodyNode()); }
  const std::vector<BodyNode*>& bodies() const { return bodies_; }

private:
  void add(BodyNode& body)
  {
    bodies_.push_back(&body);
    set_.insert(&body);
  }

  std::vector<BodyNode*> bodies_;
  std::set<const BodyNode*> set_;
};

[[noreturn]] void refuse_mimic(const Joint& joint, const Joint& leader, const BodyNode& first, const char* what)
{
  throw Error(
      Kind::value,
      "joint '" + joint.getName() + "' follows joint '" + leader.getName() + "', from which " + what + " body '"
          + first.getName() + "' would part it");
}

/// Throws if a joint within follows one outside; also the other way round if the branch leaves the skeleton.
void check_mimics(const Branch& branch, const char* what, bool leaves)
{
  const auto& first = *branch.bodies().front();
  for (const auto* joint : first.getSkeleton()->getJoints())
    if (const auto* leader = joint->getMimicJoint())
      if (branch.has(*joint) != branch.has(*leader) && (leaves || branch.has(*joint)))
        refuse_mimic(*joint, *leader, first, what);
}

/// Throws if a joint follows the one that the branch hangs from, which goes.
void check_root_leads_none(const Branch& branch, const char* what)
{
  const auto& first = *branch.bodies().front();
  for (const auto* joint : first.getSkeleton()->getJoints())
    if (joint->getMimicJoint() == first.getParentJoint() && joint != first.getParentJoint())
      refuse_mimic(*joint, *first.getParentJoint(), first, what);
}

/// Does something to the tree that makes the detector's objects anew.
template <class Change>
void change_shapes(WorldRecord& world, Change change)
{
  const auto lock = lock_ode();
  auto& solver = *world.world->getConstraintSolver();
  solver.clearLastCollisionResult(); // it points to shapes of bodies that move
  change();
  use_detector(solver, solver.getCollisionDetector());
}

/// Armature goes where the dofs go.
void hand_over_armature(const Branch& branch, SkeletonRecord& from, SkeletonRecord& to)
{
  for (const auto* body : branch.bodies())
    for (std::size_t i = 0; i < body->getParentJoint()->getNumDofs(); ++i)
      if (auto node = from.armature.extract(const_cast<BodyNode*>(body)->getParentJoint()->getDof(i)))
        to.armature.insert(std::move(node));
}

/// A skeleton of no world that is equal in all but its armature.
dart::dynamics::SkeletonPtr equal_skeleton(SkeletonRecord& record)
{
  SkeletonRecord copy{built::skeleton_of(built::structure_of(*record.skeleton))};
  Archive out;
  visit_skeleton(out, record);
  Archive in(out.texts, out.numbers);
  visit_skeleton(in, copy);
  copy.skeleton->setPositions(record.skeleton->getPositions());
  copy.skeleton->setVelocities(record.skeleton->getVelocities());
  return copy.skeleton;
}

/// What the collision filter says of bodies, it says of their copies.
void copy_in_filter(WorldRecord& world, const std::map<const BodyNode*, BodyNode*>& copies)
{
  const auto copy_of = [&](BodyNode* body) {
    const auto found = copies.find(body);
    return found == copies.end() ? body : found->second;
  };
  const auto pairs = world.ignored_pairs;
  for (const auto& [a, b] : pairs)
    if (copy_of(a) != a || copy_of(b) != b)
      world.ignored_pairs.emplace_back(copy_of(a), copy_of(b));
  for (const auto& [body, copy] : copies)
    if (const auto found = world.collision_bits.find(body); found != world.collision_bits.end()) {
      const auto bits = found->second;
      world.collision_bits[copy] = bits;
    }
  apply_collision_filter(world);
}

} // namespace

std::vector<std::string> SkeletonHandle::move_branch(
    long of_skeleton,
    long body,
    long parent,
    const std::string& joint_type,
    const std::string& joint_name,
    const MatrixIn& axes)
{
  auto& to = skeleton();
  auto& world = *skeleton_.world;
  const auto source_ref = world.skeletons[check::index(of_skeleton, world.skeletons.size(), "skeleton")];
  auto& source = *source_ref;
  auto& first = *source.skeleton->getBodyNode(check::index(body, source.skeleton->getNumBodyNodes(), "body"));
  auto* above = parent_at(parent);
  const Branch branch(first);
  if (above != nullptr && branch.has(above))
    throw Error(
        Kind::value,
        "body '" + first.getName() + "' cannot hang from '" + above->getName() + "', which "
            + (above == &first ? "is itself" : "hangs from it"));
  check_tree_can_change("attach()");
  SkeletonHandle(skeleton_.world, source_ref).check_tree_can_change("attach()");
  const bool leaves = &source != skeleton_.skeleton.get();
  if (leaves)
    check_mimics(branch, "moving", true);
  if (joint_name != first.getParentJoint()->getName() || leaves)
    check_new_name(joint_name, to.getJoint(joint_name) != nullptr, "joint");
  check_root_leads_none(branch, "moving");
  const auto joint = built::new_joint(joint_type, joint_name, axes);
  mark_built(world, source);
  mark_built(world, *skeleton_.skeleton);
  world.about_to_change(source);
  std::set<dart::dynamics::DegreeOfFreedom*> gone;
  for (std::size_t i = 0; i < first.getParentJoint()->getNumDofs(); ++i)
    gone.insert(first.getParentJoint()->getDof(i));
  change_shapes(world, [&] { built::hang(to, above, first, joint); });
  for (auto* dof : gone)
    source.armature.erase(dof);
  if (leaves)
    hand_over_armature(branch, source, *skeleton_.skeleton);
  first.getParentJoint()->setName(joint_name);
  world.tree_changed(source);
  if (leaves)
    world.tree_changed(*skeleton_.skeleton);
  std::vector<std::string> names;
  for (const auto* moved : branch.bodies())
    names.push_back(moved->getName());
  return names;
}

int SkeletonHandle::copy_branch(long of_skeleton, long body, long parent)
{
  auto& to = skeleton();
  auto& world = *skeleton_.world;
  auto& source = *world.skeletons[check::index(of_skeleton, world.skeletons.size(), "skeleton")];
  auto& first = *source.skeleton->getBodyNode(check::index(body, source.skeleton->getNumBodyNodes(), "body"));
  auto* above = parent_at(parent);
  const Branch branch(first);
  check_tree_can_change("copy_branch()");
  check_mimics(branch, "copying", false);
  mark_built(world, *skeleton_.skeleton);
  const auto whole = equal_skeleton(source);
  std::map<const BodyNode*, BodyNode*> copies;
  Armature armature;
  for (auto* original : branch.bodies()) {
    auto* copy = copies[original] = whole->getBodyNode(original->getIndexInSkeleton());
    for (std::size_t i = 0; i < copy->getParentJoint()->getNumDofs(); ++i)
      if (const auto found = source.armature.find(original->getParentJoint()->getDof(i)); found != source.armature.end())
        armature[copy->getParentJoint()->getDof(i)] = found->second;
  }
  built::about_to_move(*copies[&first]);
  change_shapes(world, [&] { copies[&first]->moveTo(to.getPtr(), above); });
  skeleton_.skeleton->armature.insert(armature.begin(), armature.end());
  copy_in_filter(world, copies);
  world.tree_changed(*skeleton_.skeleton);
  return static_cast<int>(copies[&first]->getIndexInSkeleton());
}

} // namespace pydart2
