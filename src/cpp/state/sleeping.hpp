#pragma once

#include <dart/collision/CollisionResult.hpp>

#include "state/world_record.hpp"

namespace pydart2 {

/// A group of skeletons that contacts and constraints connect sleeps when all its bodies have been slow for a while and
/// what carries it is static or asleep. To the engine a sleeper is immobile, and no loop of a step runs over sleepers. A
/// group wakes when a body touches one of it that is awake, and by whatever changes one of it or the world.

/// Lets groups sleep as the world's settings have it, after a step.
void fall_asleep(WorldRecord& world);

/// Wakes what is touched; the skeletons that woke. There are no contacts among these in `contacts`.
std::vector<SkeletonRef> wake_touched(WorldRecord& world, const dart::collision::CollisionResult& contacts);

/// Wakes a skeleton with its group, or all if it is one that carries.
void wake(WorldRecord& world, SkeletonRecord& skeleton);
void wake_all(WorldRecord& world);

/// What a constraint is about to hold differently.
void wake_held(WorldRecord& world, const ConstraintRecord& constraint);

/// To be called when the world's skeletons are others.
void find_awake(WorldRecord& world);

/// What speaks of skeletons by index, when one is gone.
void forget_sleeper(WorldRecord& world, int index);

/// For as long as this lives, all can move.
class AllMobile
{
public:
  explicit AllMobile(WorldRecord& world);
  ~AllMobile();
  AllMobile(const AllMobile&) = delete;
  AllMobile& operator=(const AllMobile&) = delete;

private:
  WorldRecord& world_;
  std::unordered_set<const dart::dynamics::Skeleton*> asleep_;
};

/// Who sleeps and for how long all have been slow, in numbers; none where sleeping is off.
std::vector<double> sleep_numbers(const WorldRecord& world);

/// How many of `numbers` are those, from an index on; ValueError if they cannot be.
std::size_t count_sleep_numbers(const WorldRecord& world, const std::vector<double>& numbers, std::size_t begin);

/// All are awake before.
void restore_sleep(WorldRecord& world, const double* numbers);

} // namespace pydart2
