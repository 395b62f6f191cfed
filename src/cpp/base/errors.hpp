#pragma once

#include <stdexcept>
#include <string>

namespace pydart2 {

/// The Python exception that an Error becomes (swig/exceptions.i).
enum class Kind { value, type, index, load, destroyed, simulation, engine };

/// The one exception that this layer throws: a sentence for a person, and what it is in Python.
class Error : public std::runtime_error
{
public:
  Error(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}

  Kind kind() const { return kind_; }

private:
  Kind kind_;
};

} // namespace pydart2
