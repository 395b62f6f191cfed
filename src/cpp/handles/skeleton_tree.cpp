#include <dart/constraint/ConstraintSolver.hpp>
#include <set>

#include "base/checks.hpp"
#include "collision/detector.hpp"
#include "handles/skeleton.hpp"
#include "loading/built.hpp"
#include "state/clone.hpp"

namespace pydart2 {

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
  check::shape(axes, static_cast<std::size_t>(axes.rows), 3, "axes");
  built::NewJoint joint{joint_type, joint_name, {}};
  for (long i = 0; i < axes.rows; ++i) {
    joint.axes.emplace_back(Eigen::Map<const Eigen::Vector3d>(axes.data + 3 * i));
    check::direction(joint.axes.back(), "axis");
  }
  if (joint.axes.size() == 2 && joint.axes[0].cross(joint.axes[1]).norm() < 1e-6)
    throw Error(Kind::value, "the two axes must not be parallel");
  if (parent < -1)
    check::index(parent, skel.getNumBodyNodes(), "parent");
  auto* above = parent == -1 ? nullptr : skel.getBodyNode(check::index(parent, skel.getNumBodyNodes(), "parent"));
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
  first->remove();
  use_detector(solver, solver.getCollisionDetector());
  world.tree_changed(*skeleton_.skeleton);
}

void SkeletonHandle::check_new_name(const std::string& name, bool taken, const char* what) const
{
  if (name.empty())
    throw Error(Kind::value, std::string("a ") + what + " needs a name");
  if (taken)
    throw Error(Kind::value, "skeleton '" + skeleton().getName() + "' has a " + what + " '" + name + "' already");
}

} // namespace pydart2
