#include "engine/static_guards.hpp"

#include <dlfcn.h>

#include <shared_mutex>

#include "base/fork.hpp"
#include "engine/import_table.hpp"

namespace pydart2 {

namespace {

/// Shared by all threads that are inside.
HeldOverFork<std::shared_mutex>* first_times = nullptr;

/// One static may need another.
thread_local int depth = 0;

void enter()
{
  if (first_times != nullptr && depth++ == 0)
    first_times->lock_shared();
}

void leave()
{
  if (first_times != nullptr && --depth == 0)
    first_times->unlock_shared();
}

template <class Result>
Result standard(const char* name, void* guard)
{
  return reinterpret_cast<Result (*)(void*)>(dlsym(RTLD_DEFAULT, name))(guard);
}

} // namespace

// What compilers call around a first time (Itanium C++ ABI, 3.3.3). This library's own calls come here, for the names are
// defined in it and not exported.

int acquire(void* guard) asm("__cxa_guard_acquire");
void release(void* guard) asm("__cxa_guard_release");
void abandon(void* guard) asm("__cxa_guard_abort");

/// Whether it is for the caller to do.
int acquire(void* guard)
{
  enter();
  const int is_first = standard<int>("__cxa_guard_acquire", guard);
  if (is_first == 0)
    leave();
  return is_first;
}

void release(void* guard)
{
  standard<void>("__cxa_guard_release", guard);
  leave();
}

void abandon(void* guard)
{
  standard<void>("__cxa_guard_abort", guard);
  leave();
}

void hold_guards_over_fork()
{
  first_times = new HeldOverFork<std::shared_mutex>(ForkOrder::first_times);
  const auto libraries = {"libdart", "libode", "libfcl", "liboctomap", "libBullet", "libLinearMath", "libassimp", "libdraco"};
  redirect(libraries, "__cxa_guard_acquire", reinterpret_cast<void*>(&acquire));
  redirect(libraries, "__cxa_guard_release", reinterpret_cast<void*>(&release));
  redirect(libraries, "__cxa_guard_abort", reinterpret_cast<void*>(&abandon));
}

} // namespace pydart2
