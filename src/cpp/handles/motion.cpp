#include "handles/motion.hpp"

#include "dynamics/tree_dynamics.hpp"
#include "engine/tree_members.hpp"

namespace pydart2 {

using dart::dynamics::BodyNode;
using engine::EntityMembers;

namespace {

/// Null for the engine, and before the first step.
TreeDynamics* mover(const WorldRecord& world, const SkeletonRecord& skeleton)
{
  const bool is_ours = world.dynamics == Dynamics::fast && skeleton.dynamics_structure == skeleton.structure;
  return is_ours ? skeleton.made_dynamics.get() : nullptr;
}

} // namespace

void find_pose(const WorldRecord& world, const SkeletonRecord& skeleton, const BodyNode& body)
{
  auto* ours = body.*EntityMembers::transform_dirty ? mover(world, skeleton) : nullptr;
  if (ours != nullptr)
    ours->find_pose(body);
}

void find_velocity(const WorldRecord& world, const SkeletonRecord& skeleton, const BodyNode& body)
{
  auto* ours = body.*EntityMembers::velocity_dirty ? mover(world, skeleton) : nullptr;
  if (ours != nullptr)
    ours->find_velocity(body);
}

} // namespace pydart2
