#pragma once

#include <dart/simulation/World.hpp>
#include <string>

namespace pydart2 {

/// The world of a SKEL file; LoadError if it cannot be read.
dart::simulation::WorldPtr load_world(const std::string& path);

/// The world of a SKEL text.
dart::simulation::WorldPtr load_world_text(const std::string& xml);

/// The skeleton of a URDF, SDF, SKEL or VSK file, by extension; LoadError if it cannot be read.
dart::dynamics::SkeletonPtr load_skeleton(const std::string& path);

} // namespace pydart2
