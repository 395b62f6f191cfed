#pragma once

#include <dart/collision/CollisionGroup.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/PointMass.hpp>
#include <dart/dynamics/Skeleton.hpp>

/// Protected members of DART 6.12's classes, reached as a derived class may. A version that renames one does not compile.
namespace pydart2 {

/// The engine's own memory for M and c, and whether they are out of date. Filling that instead of a second one keeps one
/// truth, and lets the engine's own bookkeeping say when they have to be computed again.
struct EngineCache : dart::dynamics::Skeleton
{
  static auto& of(dart::dynamics::Skeleton& skeleton) { return skeleton.*(&EngineCache::mSkelCache); }
};

/// A constraint solver's detector and the group of what collides.
struct SolverMembers : dart::constraint::ConstraintSolver
{
  static auto& detector_of(ConstraintSolver& solver) { return solver.*(&SolverMembers::mCollisionDetector); }
  static auto& group_of(ConstraintSolver& solver) { return solver.*(&SolverMembers::mCollisionGroup); }
};

/// What each of a group's objects has in its detector's own library, and the tree of them there.
struct GroupMembers : dart::collision::CollisionGroup
{
  static void update_engine_data(CollisionGroup& group) { (group.*(&GroupMembers::updateEngineData))(); }
};

/// What hangs on a frame. A node that is removed from its body still does, for as long as somebody holds it.
struct HangingMembers : dart::dynamics::Entity
{
  static void let_go(Entity& entity) { (entity.*(&HangingMembers::changeParentFrame))(nullptr); }
};

/// The external force on a point of a soft body, in its body's axes.
struct PointMembers : dart::dynamics::PointMass
{
  static Eigen::Vector3d& external_force(PointMass& point) { return point.*(&PointMembers::mFext); }
};

} // namespace pydart2
