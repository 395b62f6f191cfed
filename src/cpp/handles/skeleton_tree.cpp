// Bodies that come and go, and the joint of the root.

#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <set>

#include "base/checks.hpp"
#include "collision/detector.hpp"
#include "handles/skeleton.hpp"
#include "loading/built.hpp"
#include "loading/root_joint.hpp"
#include "state/clone.hpp"

namespace pydart2 {

using dart::dynamics::Joint;

namespace {

/// Takes what is about to go out of what the world keeps of bodies and dofs.
void forget_bodies(WorldRecord& world, SkeletonRecord& skeleton, const std::set<const dart::dynamics::BodyNode*>& gone)
{
  forget_in_filter(world, gone);
  for (auto one = skeleton.armature.begin(); one != skeleton.armature.end();)
    one = gone.count(one->first->getChildBodyNode()) != 0 ? skeleton.armature.erase(one) : std::next(one);
}

} // namespace

int SkeletonHandle::add_body(
    long parent,
    const std::string& name,
    const std::string& joint_type,
    const std::string& joint_name,
    const MatrixIn& axes)
{
  return add_new(parent, name, joint_type, joint_name, axes, nullptr);
}

int SkeletonHandle::add_soft_body(
    long parent,
    const std::string& name,
    const std::string& joint_type,
    const std::string& joint_name,
    const MatrixIn& axes,
    const MatrixIn& points,
    const VectorIn& masses,
    const MatrixIn& edges,
    const MatrixIn& faces)
{
  const auto skin = built::make_skin(points, masses, edges, faces);
  return add_new(parent, name, joint_type, joint_name, axes, &skin);
}

int SkeletonHandle::add_new(
    long parent,
    const std::string& name,
    const std::string& joint_type,
    const std::string& joint_name,
    const MatrixIn& axes,
    const built::Skin* skin)
{
  auto& skel = skeleton();
  check_tree_can_change("add_body()");
  check_new_name(name, skel.getBodyNode(name) != nullptr, "body");
  check_new_name(joint_name, skel.getJoint(joint_name) != nullptr, "joint");
  const auto joint = built::new_joint(joint_type, joint_name, axes);
  auto* above = parent_at(parent);
  mark_built(*skeleton_.world, *skeleton_.skeleton);
  const auto& body = built::add_body(skel, above, name, joint, skin);
  skeleton_.world->tree_changed(*skeleton_.skeleton);
  return static_cast<int>(body.getIndexInSkeleton());
}

void SkeletonHandle::remove_body(long index)
{
  auto& skel = skeleton();
  auto* first = skel.getBodyNode(check::index(index, skel.getNumBodyNodes(), "body"));
  check_tree_can_change("remove_body()");
  std::set<const dart::dynamics::BodyNode*> gone{first};
  for (auto* body : skel.getBodyNodes()) // parents come first
    if (gone.count(body->getParentBodyNode()) != 0)
      gone.insert(body);
  for (const auto* joint : skel.getJoints())
    if (const auto* leader = joint->getMimicJoint())
      if (gone.count(joint->getChildBodyNode()) == 0 && gone.count(leader->getChildBodyNode()) != 0)
        throw Error(
            Kind::value,
            "joint '" + joint->getName() + "' follows joint '" + leader->getName() + "', which would go with body '"
                + first->getName() + "'");
  auto& world = *skeleton_.world;
  mark_built(world, *skeleton_.skeleton);
  forget_bodies(world, *skeleton_.skeleton, gone);
  const auto lock = lock_ode();
  auto& solver = *world.world->getConstraintSolver();
  solver.clearLastCollisionResult(); // it points to shapes that go
  built::about_to_move(*first);
  first->remove();
  use_detector(solver, solver.getCollisionDetector());
  world.tree_changed(*skeleton_.skeleton);
}

dart::dynamics::BodyNode* SkeletonHandle::parent_at(long index) const
{
  auto& skel = skeleton();
  return index == -1 ? nullptr : skel.getBodyNode(check::index(index, skel.getNumBodyNodes(), "parent"));
}

void SkeletonHandle::check_new_name(const std::string& name, bool taken, const char* what) const
{
  if (name.empty())
    throw Error(Kind::value, std::string("a ") + what + " needs a name");
  if (taken)
    throw Error(Kind::value, "skeleton '" + skeleton().getName() + "' has a " + what + " '" + name + "' already");
}

void SkeletonHandle::check_root_can_change(const char* what) const
{
  if (skeleton().getNumBodyNodes() == 0)
    throw Error(Kind::value, std::string(what) + " needs a skeleton with a body; '" + name() + "' has none");
  check_tree_can_change(what);
  const Joint* root = skeleton().getRootJoint();
  for (const Joint* joint : skeleton().getJoints())
    if (joint != root && joint->getMimicJoint() == root)
      throw Error(
          Kind::value,
          "joint '" + joint->getName() + "' follows joint '" + root->getName() + "', in whose place " + what
              + " would put another one");
}

void SkeletonHandle::check_tree_can_change(const char* what) const
{
  if (skeleton_.skeleton->not_numbers)
    throw Error(
        Kind::value,
        std::string(what) + " cannot change skeleton '" + name() + "', which reads NaN since it blew up; set its state first");
  if (skeleton_.skeleton->motors.targets())
    throw Error(
        Kind::value,
        std::string(what) + " cannot change skeleton '" + name() + "' while its dofs have targets; call clear_targets() first");
  for (const auto& record : skeleton_.world->constraints)
    if (record.skeleton1 == skeleton_.skeleton->skeleton || record.skeleton2 == skeleton_.skeleton->skeleton)
      throw Error(
          Kind::value,
          std::string(what) + " cannot change skeleton '" + name()
              + "' while a constraint holds it; call world.remove_all_constraints() first");
}

void SkeletonHandle::forget_root_armature()
{
  auto& joint = *skeleton().getRootJoint();
  for (std::size_t i = 0; i < joint.getNumDofs(); ++i)
    skeleton_.skeleton->armature.erase(joint.getDof(i));
}

void SkeletonHandle::set_root_joint_to_trans_and_euler()
{
  check_root_can_change("set_root_joint_to_trans_and_euler()");
  forget_root_armature();
  change_root_to_trans_and_euler(skeleton());
  tree_changed(RootChange::trans_and_euler);
}

void SkeletonHandle::set_root_joint_to_weld()
{
  check_root_can_change("set_root_joint_to_weld()");
  forget_root_armature();
  change_root_to_weld(skeleton());
  tree_changed(RootChange::weld);
}

void SkeletonHandle::set_root_joint_to_free()
{
  check_root_can_change("set_root_joint_to_free()");
  const Joint& joint = *skeleton().getRootJoint();
  if (joint.getType() == dart::dynamics::FreeJoint::getStaticType())
    return;
  if (joint.getNumDofs() > 0)
    throw Error(
        Kind::value,
        "the root of skeleton '" + name() + "' is on a " + joint.getType() + ", '" + joint.getName()
            + "'; only a root that is fixed can be made free");
  change_root_to_free(skeleton());
  tree_changed(RootChange::free);
}

void SkeletonHandle::tree_changed(RootChange change)
{
  note_root_change(*skeleton_.world, *skeleton_.skeleton, change);
  skeleton_.world->tree_changed(*skeleton_.skeleton);
}

} // namespace pydart2
