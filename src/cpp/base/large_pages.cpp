#include "base/large_pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <fstream>
#include <string>

#ifndef MADV_COLLAPSE
#define MADV_COLLAPSE 25 // younger than Debian 12's headers
#endif

namespace pydart2 {

namespace {

constexpr std::uintptr_t page = 2 << 20;
constexpr std::uintptr_t much = 32 * page;

/// In whole pages; the end of the address space if there is no such heap.
std::uintptr_t heap_begin()
{
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    if (line.find("[heap]") != std::string::npos)
      return (std::stoull(line, nullptr, 16) + page - 1) / page * page;
  return UINTPTR_MAX - much;
}

} // namespace

void use_large_pages()
{
  static std::atomic<std::uintptr_t> done{heap_begin()};
  const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0)) / page * page;
  auto begin = done.load();
  if (end >= begin && end < begin + much)
    return;
  if (done.compare_exchange_strong(begin, end) && end > begin)
    madvise(reinterpret_cast<void*>(begin), end - begin, MADV_COLLAPSE); // else the pages are as they were
}

} // namespace pydart2
