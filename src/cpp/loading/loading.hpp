#pragma once

#include <dart/simulation/World.hpp>

#include "loading/model_source.hpp"

namespace pydart2 {

/// The world of a SKEL, SDF, URDF world or MJCF source; LoadError with the engine's reason if there is none.
dart::simulation::WorldPtr load_world(const ModelSource& source);

/// The skeleton of a SKEL, SDF, URDF, MJCF or VSK source; LoadError with the engine's reason if there is none.
dart::dynamics::SkeletonPtr load_skeleton(const ModelSource& source);

} // namespace pydart2
