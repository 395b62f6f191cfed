#pragma once

#include <cstddef>

namespace pydart2 {

/// Have memory, of one member or from one to another of the same object, brought to the cache. Where there are many skeletons
/// nothing of a step is left there in the next, and waiting takes most of the time.
template <class Member>
void fetch(const Member& member)
{
  __builtin_prefetch(&member);
}

template <class First, class Last>
void fetch(const First& first, const Last& last)
{
  constexpr std::ptrdiff_t line = 64;
  const auto* end = reinterpret_cast<const char*>(&last + 1);
  for (const auto* at = reinterpret_cast<const char*>(&first); at < end; at += line)
    __builtin_prefetch(at);
}

} // namespace pydart2
