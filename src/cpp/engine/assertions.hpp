#pragma once

namespace pydart2 {

/// From now on a failed assertion inside the engine's libraries throws an Error instead of ending the process.
///
/// The libraries' own calls of __assert_fail are redirected. It is a second line behind checks.hpp, not a substitute:
/// __assert_fail is declared not to throw, so a compiler may leave out the clean-up code of the frames above it. What
/// such frames own leaks; where a frame forbids the exception altogether (a destructor), the process ends as it would
/// have without this.
void make_assertions_throw();

} // namespace pydart2
