#pragma once

namespace pydart2 {

/// From now on a fork waits for threads that are inside of the first time of a static within a function, in this library and
/// in the engine's. A child, where such a thread is missing, would wait for it for ever: for the static's guard, or for the
/// lock of the list of what is to do at exit, which the C library leaves as it is.
void hold_guards_over_fork();

} // namespace pydart2
