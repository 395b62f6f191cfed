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

struct Entries
{
  std::mutex mutex; ///< Held over the fork too: nobody adds one meanwhile.
  std::vector<Entry> sorted;
};

Entries& entries()
{
  static auto& all = *new Entries; // also for a fork at the very end of the process
  return all;
}

void before()
{
  entries().mutex.lock();
  for (const auto& entry : entries().sorted)
    entry.before(entry.mutex);
}

void in_parent()
{
  for (auto entry = entries().sorted.rbegin(); entry != entries().sorted.rend(); ++entry)
    entry->in_parent(entry->mutex);
  entries().mutex.unlock();
}

void in_child()
{
  for (const auto& entry : entries().sorted)
    entry.in_child(entry.mutex);
  entries().mutex.unlock();
}

} // namespace

void at_fork(ForkOrder order, void (*parent_before)(void*), void (*parent_after)(void*), void (*child)(void*), void* mutex)
{
  static const int once = pthread_atfork(before, in_parent, in_child);
  static_cast<void>(once);
  const std::lock_guard<std::mutex> lock(entries().mutex);
  auto& sorted = entries().sorted;
  const auto after = std::find_if(sorted.begin(), sorted.end(), [&](const Entry& entry) { return entry.order > order; });
  sorted.insert(after, {order, parent_before, parent_after, child, mutex});
}

} // namespace pydart2
