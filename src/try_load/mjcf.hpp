#pragma once

#include <string>

/// MuJoCo's compiler, of the libraries that a request names. A request: "mjcf", the path of MuJoCo's library and those of
/// its plugins, a line each; an empty line; the path of the file, or an empty line for a text without one; the text.
namespace mjcf {

bool is_request(const std::string& request);

/// Loads the libraries, before the process of the trial is made: that takes most of the time.
void open_libraries(const std::string& request);

/// Compiles the model; the exit code, which is 0 also where MuJoCo refuses it with a sentence.
int compile(const std::string& request);

} // namespace mjcf
