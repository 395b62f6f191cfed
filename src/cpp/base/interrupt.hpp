#pragma once

#include <atomic>
#include <chrono>

#include "base/fork.hpp"

namespace pydart2 {

/// While there are any, a process that ends does so without the libraries taking down what they use.
inline std::atomic<int> threads_inside{0};

/// Lets a long call end when the user asks for it (Ctrl-C): for its life, poll() on this thread asks at most twenty times
/// a second. What `ask` throws comes out of poll().
class Interruptible
{
public:
  using Ask = void (*)(void*);

  Interruptible(Ask ask, void* argument) : ask_(ask), argument_(argument), before_(current) { current = this; }
  ~Interruptible() { current = before_; }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// To be called between the steps of what may take long; on other threads it does nothing, nor with a lock held that
  /// one may wait for who has what is asked (the interpreter's lock).
  static void poll()
  {
    if (current != nullptr)
      current->poll_here();
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto pause = std::chrono::milliseconds(50);

  void poll_here()
  {
    const auto now = Clock::now();
    if (now < next_ || locks_held > 0)
      return;
    next_ = now + pause;
    ask_(argument_);
  }

  inline static thread_local Interruptible* current = nullptr;
  Ask ask_;
  void* argument_;
  Interruptible* before_;
  Clock::time_point next_ = Clock::now() + pause;
};

} // namespace pydart2
