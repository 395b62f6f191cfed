#pragma once

#include "state/world_record.hpp"

namespace pydart2 {

/// One time step: what dart::simulation::World::step does, phase by phase, with the numbers checked between the phases.
/// Throws Kind::simulation if the simulation blows up; positions, velocities and accelerations are then those before
/// the step.
void advance(WorldRecord& world);

/// So that none is left of an earlier step.
void clear_impulses(dart::dynamics::Skeleton& skeleton);

/// Collision detection and the constraint impulses, for a state at the given time, of skeletons without impulses.
void solve_constraints(WorldRecord& world, double time);

} // namespace pydart2
