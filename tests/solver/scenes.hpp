// Worlds to compare solvers in: a model, a collision detector, and a variation that brings the features of joints and
// contacts into play.

#pragma once

#include <dart/simulation/World.hpp>
#include <string>
#include <vector>

/// plain:   as the file has it, from a random state.
/// joints:  limits, Coulomb friction, damping, springs, and all actuator kinds, with commands.
/// surface: restitution, slip, no friction here and there, self collision.
/// joined:  ball and weld joints between bodies of the same and of different skeletons, and mimic joints.
/// pile:    four skeletons more that fall onto each other, jointed ones among them.
extern const std::vector<std::string> variations;

/// The same world each time: numbers are random, but from a fixed seed.
dart::simulation::WorldPtr make_scene(
    const std::string& model, const std::string& detector, const std::string& variation);

/// Commands of a step, the same for the same step.
void command(dart::simulation::World& world, int step);
