#include "handles/engine_info.hpp"

#include <dart/config.hpp>

#include "contact/fast_solver.hpp"
#include "dynamics/dynamics_choice.hpp"
#include "engine/library.hpp"

namespace pydart2 {

std::string engine_version()
{
  return DART_VERSION;
}

bool engine_has_assertions()
{
  return engine::has_assertions();
}

std::string engine_prefix()
{
  return engine::prefix();
}

std::string default_solver_name()
{
  return name_of(default_solver());
}

std::string default_dynamics_name()
{
  return name_of(default_dynamics());
}

} // namespace pydart2
