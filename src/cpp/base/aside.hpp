#pragma once

#include <functional>
#include <memory>
#include <utility>

namespace pydart2 {

/// Does work on a thread of its own, where no signals arrive, while this one answers them (base/interrupt.hpp). If that or
/// the time ends the wait, the work goes on by itself and what it has is freed there: it may refer to nothing of the
/// caller's. LoadError if it takes more seconds of the processor.
void run_aside(double seconds, std::function<void()> work);

/// What a call returns that is made so.
template <class Call>
auto aside(double seconds, Call call)
{
  const auto result = std::make_shared<decltype(call())>();
  run_aside(seconds, [result, call = std::move(call)] { *result = call(); });
  return std::move(*result);
}

} // namespace pydart2
