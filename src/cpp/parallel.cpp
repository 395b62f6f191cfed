#include "parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace pydart2 {

void parallel_for(std::size_t count, std::size_t num_threads, const std::function<void(std::size_t)>& work)
{
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> thrown(count);
  const auto take_turns = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    }
  };
  std::vector<std::thread> others;
  while (others.size() + 1 < std::min(num_threads, count)) {
    try {
      others.emplace_back(take_turns);
    } catch (const std::system_error&) {
      break; // no more threads to be had: those that there are do it
    }
  }
  take_turns();
  for (auto& thread : others)
    thread.join();
  for (const auto& exception : thrown)
    if (exception)
      std::rethrow_exception(exception);
}

} // namespace pydart2
