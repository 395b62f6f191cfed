#pragma once

namespace pydart2::python {

/// From now on an exception of ours that nobody can catch (an assertion of the engine in a call that may not throw) ends
/// the process with what it says and with the Python lines that led there, on stderr. Others end it as before.
void set_last_words();

} // namespace pydart2::python
