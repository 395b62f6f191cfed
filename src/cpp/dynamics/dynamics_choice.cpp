#include "dynamics/dynamics_choice.hpp"

#include <cstdlib>

#include "base/errors.hpp"

namespace pydart2 {

Dynamics dynamics_named(const std::string& name)
{
  if (name == "engine")
    return Dynamics::engine;
  if (name == "fast")
    return Dynamics::fast;
  throw Error(Kind::value, "no dynamics '" + name + "'; there are engine and fast");
}

const char* name_of(Dynamics dynamics)
{
  return dynamics == Dynamics::fast ? "fast" : "engine";
}

Dynamics default_dynamics()
{
  const char* name = std::getenv("PYDART2_DYNAMICS");
  if (name == nullptr || *name == '\0')
    return Dynamics::fast;
  try {
    return dynamics_named(name);
  } catch (const Error& error) {
    throw Error(Kind::value, std::string("environment variable PYDART2_DYNAMICS: ") + error.what());
  }
}

} // namespace pydart2
