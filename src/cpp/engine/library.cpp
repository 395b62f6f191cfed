#include "engine/library.hpp"

#include <dart/constraint/ConstraintBase.hpp>
#include <dlfcn.h>
#include <filesystem>

namespace pydart2::engine {

bool has_assertions()
{
  // BoxedLcpConstraintSolver::isSymmetric(unsigned long, double*) is called by an assertion only and left out without.
  return dlsym(RTLD_DEFAULT, "_ZN4dart10constraint24BoxedLcpConstraintSolver11isSymmetricEmPd") != nullptr;
}

std::string prefix()
{
  Dl_info library{};
  const auto* function = reinterpret_cast<const void*>(&dart::constraint::ConstraintBase::compressPath);
  if (dladdr(function, &library) == 0 || library.dli_fname == nullptr)
    return "";
  const auto path = std::filesystem::weakly_canonical(library.dli_fname).string(); // /lib is a link to /usr/lib
  return path.substr(0, path.rfind("/lib/"));
}

} // namespace pydart2::engine
