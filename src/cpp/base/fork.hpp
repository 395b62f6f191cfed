#pragma once

#include <mutex>
#include <new>

namespace pydart2 {

/// In the order in which threads take them.
enum class ForkOrder { manager, ode, meshes, scenes, first_times, innermost };

/// Has these called before the process forks, and after it in the parent and in the child. To be called while there is one
/// thread.
void at_fork(ForkOrder order, void (*before)(void*), void (*in_parent)(void*), void (*in_child)(void*), void* mutex);

/// How many of the mutexes below this thread is inside of.
inline thread_local int locks_held = 0;

/// A mutex that no other thread is inside of when the process forks, for what lives as long as the process: the child
/// finds it free, and what it protects whole. None may be held by a thread that waits for the interpreter. All are made
/// before there are other threads.
template <class Mutex>
class HeldOverFork
{
public:
  explicit HeldOverFork(ForkOrder order)
  {
    at_fork(
        order, [](void* self) { of(self).lock(); }, [](void* self) { of(self).unlock(); },
        [](void* self) { new (&of(self)) Mutex; }, // a recursive one knows its thread by a number that is another now
        this);
  }
  HeldOverFork(const HeldOverFork&) = delete;
  HeldOverFork& operator=(const HeldOverFork&) = delete;

  void lock()
  {
    mutex_.lock();
    ++locks_held;
  }

  void unlock()
  {
    --locks_held;
    mutex_.unlock();
  }

  void lock_shared()
  {
    mutex_.lock_shared();
    ++locks_held;
  }

  void unlock_shared()
  {
    --locks_held;
    mutex_.unlock_shared();
  }

private:
  static Mutex& of(void* self) { return static_cast<HeldOverFork*>(self)->mutex_; }

  Mutex mutex_;
};

} // namespace pydart2
