#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <deque>
#include <exception>
#include <functional>
#include <system_error>
#include <thread>
#include <vector>

#include "base/messages.hpp"

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
  std::deque<std::vector<messages::Message>> said;
  const auto help = [&take_turns](std::vector<messages::Message>& said_here) {
    const messages::Listening listening;
    take_turns();
    said_here = messages::take();
  };
  std::vector<std::thread> others;
  while (others.size() + 1 < std::min(num_threads, count)) {
    try {
      others.emplace_back(help, std::ref(said.emplace_back()));
    } catch (const std::system_error&) {
      break; // no more threads to be had: those that there are do it
    }
  }
  take_turns();
  for (auto& thread : others)
    thread.join();
  for (auto& messages : said)
    messages::give(std::move(messages));
  for (const auto& exception : thrown)
    if (exception)
      std::rethrow_exception(exception);
}

} // namespace pydart2
