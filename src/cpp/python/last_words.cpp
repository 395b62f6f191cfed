#include "python/last_words.hpp"

#include <Python.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "base/errors.hpp"

namespace pydart2::python {

namespace {

std::terminate_handler before = nullptr;

/// Of all threads; this one may have released the interpreter lock.
void print_lines()
{
  if (Py_IsInitialized() == 0)
    return;
  const auto state = PyGILState_Ensure();
  PyRun_SimpleString("import faulthandler; faulthandler.dump_traceback(2)");
  PyGILState_Release(state);
}

[[noreturn]] void end()
{
  const char* said = nullptr;
  try {
    if (std::current_exception())
      throw;
  } catch (const Error& error) {
    said = error.what();
  } catch (...) {
  }
  if (said == nullptr)
    before();
  std::fprintf(
      stderr,
      "\npydart2 has to end the process: %s.\nThis is a mistake in pydart2, which should have refused a call; the "
      "lines of your program that led to it:\n",
      said);
  print_lines();
  std::fflush(nullptr);
  std::raise(SIGABRT);
  _exit(128 + SIGABRT);
}

} // namespace

void set_last_words()
{
  before = std::set_terminate(end);
}

} // namespace pydart2::python
