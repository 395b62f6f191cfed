#pragma once

#include <Python.h>

#include <cxxabi.h>
#include <unistd.h>

#include <cstdio>

#include "base/interrupt.hpp"
#include "python_errors.hpp"

namespace pydart2::python {

/// Releases the interpreter lock for the time of a long call, which Python's signal handlers (Ctrl-C) may end.
class WithoutGil
{
public:
  WithoutGil() : state_(PyEval_SaveThread()) { ++threads_inside; }
  ~WithoutGil()
  {
    take_back();
    --threads_inside;
  }
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

  /// Ends a process whose interpreter has ended: with a daemon thread still inside a long call, it ends here, before the
  /// libraries take down what that thread uses.
  static void at_exit(int status, void*)
  {
    if (threads_inside == 0)
      return;
    std::fflush(nullptr);
    _exit(status);
  }

private:
  /// When the interpreter has ended it ends the thread by unwinding it, which may not pass a destructor nor our handlers:
  /// the thread waits for the end of the process instead, as all do from Python 3.14 on. An unwinding has no object that
  /// UndefinedBehaviorSanitizer could see bound to the reference.
  [[gnu::no_sanitize("undefined")]] void take_back()
  {
    try {
      PyEval_RestoreThread(state_);
    } catch (const abi::__forced_unwind&) {
      for (;;)
        pause();
    }
  }

  /// Python runs handlers on the main thread only.
  static void run_signal_handlers(void* self)
  {
    if (gettid() != getpid())
      return;
    auto& state = static_cast<WithoutGil*>(self)->state_;
    static_cast<WithoutGil*>(self)->take_back();
    const bool raised = PyErr_CheckSignals() != 0;
    state = PyEval_SaveThread();
    if (raised)
      throw ErrorIsSet{};
  }

  PyThreadState* state_;
  const Interruptible interruptible_{run_signal_handlers, this};
};

} // namespace pydart2::python
