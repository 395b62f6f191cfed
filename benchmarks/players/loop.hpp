// A plain C++ loop over World::step(): the limit of what any binding can reach. A library, for a loop in the process that
// it is compared with; loop_main.cpp is a program of its own.

#pragma once

#include <dart/simulation/World.hpp>
#include <utility>
#include <vector>

struct Loop
{
  dart::simulation::WorldPtr world;
  std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>> start; // positions and velocities of each skeleton
};

extern "C" {

// WORLD|- ROBOT|- DT GRAVITY STIFFNESS DAMPING WARM [Q...]: loads the scene and takes WARM steps.
Loop* loop_make(int count, const char* const* arguments);

// Back to the state after the first steps.
void loop_restart(Loop* loop);

// Takes steps; seconds of CPU time.
double loop_steps(Loop* loop, int count);

// The first position of the last skeleton, to see that it is the same simulation.
double loop_position(Loop* loop);
}
