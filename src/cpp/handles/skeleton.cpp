#include "handles/skeleton.hpp"

#include <algorithm>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/FreeJoint.hpp>

#include "base/checks.hpp"
#include "collision/detector.hpp"
#include "loading/root_joint.hpp"
#include "state/clone.hpp"

namespace pydart2 {

using dart::dynamics::DegreeOfFreedom;
using dart::dynamics::Joint;

SkeletonHandle::SkeletonHandle(WorldRef world, SkeletonRef skeleton)
  : skeleton_(world, skeleton, skeleton->skeleton.get())
{
  skeleton->last_forces(); // of a tree that has changed: now, before a step clears them
}

int SkeletonHandle::id() const
{
  skeleton_.world->check();
  return skeleton_.world->index_of(skeleton_.skeleton->skeleton);
}

std::string SkeletonHandle::name() const
{
  return skeleton().getName();
}

std::string SkeletonHandle::set_name(const std::string& name)
{
  if (name.find_first_not_of(" \t\r\n") == std::string::npos)
    throw Error(Kind::value, "a skeleton needs a name");
  const auto other = skeleton_.world->world->getSkeleton(name);
  if (other && other != skeleton_.skeleton->skeleton)
    throw Error(Kind::value, "the world has a skeleton '" + name + "' already; names are distinct");
  return skeleton().setName(name);
}

double SkeletonHandle::mass() const
{
  return skeleton().getMass();
}

bool SkeletonHandle::is_mobile() const
{
  return skeleton().isMobile() || skeleton_.skeleton->island != 0;
}

void SkeletonHandle::set_mobile(bool mobile)
{
  skeleton().setMobile(mobile);
}

bool SkeletonHandle::is_asleep() const
{
  skeleton(); // still there
  return skeleton_.skeleton->island != 0;
}

void SkeletonHandle::set_controlled(bool controlled)
{
  if (is_asleep() && controlled)
    skeleton_.get(); // which wakes it
  skeleton_.skeleton->controlled = controlled;
}

bool SkeletonHandle::self_collision_check() const
{
  return skeleton().getSelfCollisionCheck();
}

void SkeletonHandle::set_self_collision_check(bool enable)
{
  skeleton().setSelfCollisionCheck(enable);
}

bool SkeletonHandle::adjacent_body_check() const
{
  return skeleton().getAdjacentBodyCheck();
}

void SkeletonHandle::set_adjacent_body_check(bool enable)
{
  skeleton().setAdjacentBodyCheck(enable);
}

int SkeletonHandle::num_bodynodes() const
{
  return static_cast<int>(skeleton().getNumBodyNodes());
}

int SkeletonHandle::num_joints() const
{
  return static_cast<int>(skeleton().getNumJoints());
}

int SkeletonHandle::num_dofs() const
{
  return static_cast<int>(skeleton().getNumDofs());
}

int SkeletonHandle::num_markers() const
{
  return static_cast<int>(skeleton().getNumMarkers());
}

BodyNodeHandle SkeletonHandle::bodynode(long index) const
{
  auto& skel = skeleton();
  auto* body = skel.getBodyNode(check::index(index, skel.getNumBodyNodes(), "bodynode"));
  return {skeleton_.world, skeleton_.skeleton, body};
}

JointHandle SkeletonHandle::joint(long index) const
{
  auto& skel = skeleton();
  auto* joint = skel.getJoint(check::index(index, skel.getNumJoints(), "joint"));
  return {skeleton_.world, skeleton_.skeleton, joint};
}

DofHandle SkeletonHandle::dof(long index) const
{
  auto& skel = skeleton();
  auto* dof = skel.getDof(check::index(index, skel.getNumDofs(), "dof"));
  return {skeleton_.world, skeleton_.skeleton, dof};
}

MarkerHandle SkeletonHandle::marker(long index) const
{
  auto& skel = skeleton();
  auto* marker = skel.getMarker(check::index(index, skel.getNumMarkers(), "marker"));
  return {skeleton_.world, skeleton_.skeleton, marker};
}

DynamicsHandle SkeletonHandle::dynamics() const
{
  return {skeleton_.world, skeleton_.skeleton};
}

InverseKinematicsHandle SkeletonHandle::inverse_kinematics() const
{
  return {skeleton_.world, skeleton_.skeleton};
}

TargetsHandle SkeletonHandle::targets() const
{
  return {skeleton_.world, skeleton_.skeleton};
}

std::vector<std::string> SkeletonHandle::dof_names() const
{
  std::vector<std::string> names;
  for (const auto* dof : dofs())
    names.push_back(dof->getName());
  return names;
}

void SkeletonHandle::clear_external_forces()
{
  skeleton().clearExternalForces();
}

void SkeletonHandle::clear_impulse()
{
  skeleton().clearConstraintImpulses();
}

void SkeletonHandle::update_fk() const
{
  skeleton().computeForwardKinematics();
}

long SkeletonHandle::integrator_fallbacks() const
{
  skeleton(); // still there
  return skeleton_.skeleton->integrator_fallbacks;
}

} // namespace pydart2
