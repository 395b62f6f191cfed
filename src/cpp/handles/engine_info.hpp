#pragma once

#include <string>

namespace pydart2 {

/// Version of DART that this was built with, as "6.12.1".
std::string engine_version();

/// Whether the DART library that is loaded has its assertions compiled in, so that it ends the process where one fails.
bool engine_has_assertions();

/// Folder that this library is installed under, as "/usr".
std::string engine_prefix();

/// The constraint solver of new worlds (fast_solver.hpp).
std::string default_solver_name();

/// The dynamics of new worlds (dynamics_choice.hpp).
std::string default_dynamics_name();

} // namespace pydart2
