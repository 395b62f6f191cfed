#include "base/large_pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>

#ifndef MADV_COLLAPSE
#define MADV_COLLAPSE 25 // younger than Debian 12's headers
#endif

namespace pydart2 {

namespace {

constexpr std::uintptr_t page = 2 << 20;
constexpr std::uintptr_t much = 32 * page;

/// In whole pages.
std::uintptr_t heap_end()
{
  return reinterpret_cast<std::uintptr_t>(sbrk(0)) / page * page;
}

/// Up to where that is done, or not wanted: what was there at import.
std::atomic<std::uintptr_t> done{heap_end()};

} // namespace

void use_large_pages()
{
  const auto end = heap_end();
  auto begin = done.load();
  if (end >= begin && end < begin + much)
    return;
  if (done.compare_exchange_strong(begin, end) && end > begin)
    madvise(reinterpret_cast<void*>(begin), end - begin, MADV_COLLAPSE); // else the pages are as they were
}

} // namespace pydart2
