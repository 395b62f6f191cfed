#include "mjcf.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace mjcf {

namespace {

void* mujoco = nullptr; // its library

/// A function or variable of it, as mujoco/mujoco.h declares it; the trial ends without a word where it is not there.
template <class T>
T* find(const char* name)
{
  auto* found = reinterpret_cast<T*>(dlsym(mujoco, name));
  if (found == nullptr)
    _exit(0);
  return found;
}

void ignore(const char*) {}

[[noreturn]] void say(const char* message)
{
  std::fputs(message, stdout);
  std::fflush(stdout);
  _exit(1);
}

using Handler = void (*)(const char*);
using LoadFile = void*(const char* path, const void* files, char* error, int size);
using ParseText = void*(const char* text, const void* files, char* error, int size);
using Compile = void*(void* spec, const void* files);

} // namespace

bool is_request(const std::string& request)
{
  return request.compare(0, 5, "mjcf\n") == 0;
}

void open_libraries(const std::string& request)
{
  std::istringstream in(request);
  std::string path;
  std::getline(in, path);
  for (bool first = true; std::getline(in, path) && !path.empty(); first = false)
    if (auto* library = dlopen(path.c_str(), RTLD_NOW); first)
      mujoco = library;
}

int compile(const std::string& request)
{
  if (mujoco == nullptr)
    return 0;
  std::istringstream in(request.substr(request.find("\n\n") + 2));
  std::string path, error(1000, '\0');
  std::getline(in, path);
  *find<Handler>("mju_user_warning") = ignore; // or it would write a log file
  *find<Handler>("mju_user_error") = say;
  const auto size = static_cast<int>(error.size());
  if (!path.empty()) {
    find<LoadFile>("mj_loadXML")(path.c_str(), nullptr, error.data(), size);
    return 0;
  }
  const std::string text(std::istreambuf_iterator<char>(in), {});
  if (auto* spec = find<ParseText>("mj_parseXMLString")(text.c_str(), nullptr, error.data(), size))
    find<Compile>("mj_compile")(spec, nullptr);
  return 0;
}

} // namespace mjcf
