#pragma once

#include <memory>
#include <vector>

#include "contact/jointed.hpp"
#include "dynamics/free_bodies.hpp"

namespace pydart2 {

struct SkeletonRecord;
struct WorldRecord;

/// How a step goes about the skeletons that are awake: those that are one free body each are moved in an array, where the
/// world's solver and integrator allow it, the others through the engine's objects. No loop of a step runs over all.
struct StepPlan
{
  FreeBodies free;
  std::vector<std::shared_ptr<SkeletonRecord>> owners; ///< Of each body in `free`.
  std::vector<std::shared_ptr<SkeletonRecord>> others;
  std::vector<dart::dynamics::SkeletonPtr> other_skeletons;
  Jointed jointed; ///< Of them.
  bool rigid = true;     ///< No skeleton has a soft body.
  bool native = false;   ///< The detector is the native one, which looks at the velocity of each shape.
  std::size_t begun = 0; ///< How many of the others are in this step, and have saved their states.

  bool stale = true;                    ///< Someone came, went, fell asleep or woke, or the world has changed.
  std::vector<SkeletonRecord*> changed; ///< Skeletons that may have, where it is not stale.
  long round = 0;                       ///< Counts steps, so that a skeleton is in `changed` once.
  bool same = false;                    ///< Nothing has changed since the step before.
  long changes = 0;                     ///< Counts what was noted.

  /// Of a skeleton, or of more than one.
  void note_change(SkeletonRecord& skeleton);
  void note_change();
};

/// A plan without free bodies, in which all are awake; the next step makes another.
void plan_through_engine(WorldRecord& world);

/// Brings the plan up to date, at the beginning of a step.
StepPlan& make_plan(WorldRecord& world);

} // namespace pydart2
