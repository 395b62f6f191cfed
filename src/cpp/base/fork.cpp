#include "base/fork.hpp"

#include <pthread.h>

#include <algorithm>
#include <vector>

namespace pydart2 {

namespace {

struct Entry
{
  ForkOrder order;
  void (*before)(void*);
  void (*in_parent)(void*);
  void (*in_child)(void*);
  void* mutex;
};

std::vector<Entry>& entries()
{
  static auto& sorted = *new std::vector<Entry>; // also for a fork at the very end of the process
  return sorted;
}

void before()
{
  for (const auto& entry : entries())
    entry.before(entry.mutex);
}

void in_parent()
{
  for (auto entry = entries().rbegin(); entry != entries().rend(); ++entry)
    entry->in_parent(entry->mutex);
}

void in_child()
{
  for (const auto& entry : entries())
    entry.in_child(entry.mutex);
}

} // namespace

void at_fork(ForkOrder order, void (*parent_before)(void*), void (*parent_after)(void*), void (*child)(void*), void* mutex)
{
  static const int once = pthread_atfork(before, in_parent, in_child);
  static_cast<void>(once);
  auto& sorted = entries();
  const auto after = std::find_if(sorted.begin(), sorted.end(), [&](const Entry& entry) { return entry.order > order; });
  sorted.insert(after, {order, parent_before, parent_after, child, mutex});
}

} // namespace pydart2
