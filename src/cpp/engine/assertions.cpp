#include "engine/assertions.hpp"

#include <string>
#include <string_view>

#include "base/errors.hpp"
#include "engine/import_table.hpp"

namespace pydart2 {

namespace {

[[noreturn]] void failed(const char* assertion, const char* file, unsigned line, const char*)
{
  const std::string_view path(file);
  throw Error(
      Kind::engine,
      "the engine cannot go on: it expects " + std::string(assertion) + " ("
          + std::string(path.substr(path.rfind('/') + 1)) + ":" + std::to_string(line) + ")");
}

/// The engine's LCP solver calls it after a message of its own.
[[noreturn]] void aborted()
{
  throw Error(Kind::engine, "the engine cannot go on; its last message says why");
}

} // namespace

void make_assertions_throw()
{
  const auto libraries = {"libdart", "libfcl", "libode", "_pydart2_api"};
  redirect(libraries, "__assert_fail", reinterpret_cast<void*>(&failed));
  redirect(libraries, "abort", reinterpret_cast<void*>(&aborted));
}

} // namespace pydart2
