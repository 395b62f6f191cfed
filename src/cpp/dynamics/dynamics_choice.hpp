#pragma once

#include <string>

namespace pydart2 {

/// Which code moves the skeletons of a world: DART's own, or TreeDynamics with the same bits.
enum class Dynamics { engine, fast };

/// "engine" or "fast"; ValueError for any other name.
Dynamics dynamics_named(const std::string& name);
const char* name_of(Dynamics dynamics);

/// What a new world gets: "fast", or what the environment variable PYDART2_DYNAMICS names.
Dynamics default_dynamics();

} // namespace pydart2
