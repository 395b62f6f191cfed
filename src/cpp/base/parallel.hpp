#pragma once

#include <cstddef>
#include <functional>

namespace pydart2 {

/// Calls work(0) ... work(count - 1), each once, on this thread and num_threads - 1 others that take the next index as
/// they become free and sleep between the calls. If a call throws, the exception of the lowest index comes out after all
/// the others have ended. Within such a call another one keeps to its thread.
void parallel_for(std::size_t count, std::size_t num_threads, const std::function<void(std::size_t)>& work);

} // namespace pydart2
