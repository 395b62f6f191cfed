#pragma once

#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/simulation/World.hpp>
#include <mutex>
#include <string>

#include "base/archive.hpp"
#include "base/fork.hpp"

namespace pydart2 {

/// ODE keeps data per process: to be held where a world with its detector is made, used or freed. While it is held no
/// lock may be taken but those of shared_scenes.cpp and fcl_detector.cpp, under which nothing else is taken: not Python's
/// either, whose holder may wait for this one, and no file is read, which takes long.
using OdeMutex = HeldOverFork<std::recursive_mutex>;
std::unique_lock<OdeMutex> lock_ode();

/// Of each detector that make_detector() makes; one that takes its place takes it over.
struct ShapeChoice
{
  virtual ~ShapeChoice() = default;

  bool engine_shapes = false; ///< What the engine's detectors lack stays so, instead of being the native one's to find.
};

/// "dart", "fcl", "bullet", "ode" or "native"; ValueError for any other name.
dart::collision::CollisionDetectorPtr make_detector(const std::string& name);

/// Lets a solver find contacts with a detector, in the order of a world that the engine has just loaded. Shapes that
/// bodies get, lose or change later count.
void use_detector(dart::constraint::ConstraintSolver& solver, const dart::collision::CollisionDetectorPtr& detector);

/// Lets a world that the engine has made find contacts with one of make_detector(), of the same kind.
void replace_detector(dart::constraint::ConstraintSolver& solver);

/// Of a solver with one of make_detector()'s.
ShapeChoice& shape_choice(dart::constraint::ConstraintSolver& solver);

/// Lets FCL make trees quickly of shapes that come, which are not the engine's: till renew_detector().
void place_at_once(dart::constraint::ConstraintSolver& solver, bool at_once);

/// The same detector without memory of the steps before; if shapes came or went, with those that are there in their order.
void renew_detector(dart::constraint::ConstraintSolver& solver, bool shapes_changed);

/// Which detector, and how FCL treats primitive shapes.
void visit_detector(Archive& archive, dart::constraint::ConstraintSolver& solver);

} // namespace pydart2
