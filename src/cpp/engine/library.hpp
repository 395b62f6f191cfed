#pragma once

#include <string>

/// What the engine's library file tells of itself: its symbols, and where it lies.
namespace pydart2::engine {

/// Whether it was built with its assertions; judged by a private symbol of DART 6.12 that only an assertion calls. Where
/// another version lacks it, the answer is false.
bool has_assertions();

/// Folder that it is installed under, as "/usr"; empty if the loader does not know its file.
std::string prefix();

} // namespace pydart2::engine
