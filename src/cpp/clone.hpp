#pragma once

#include <string>
#include <vector>

#include "world_record.hpp"

namespace pydart2 {

/// All that it takes to make a world again, in this process or another: what it was loaded from and how its trees have
/// changed (plan), what else a user has changed (visit_model), and its state (state_of). The recording is not in it.
struct Blueprint
{
  std::vector<std::string> plan;
  std::vector<std::string> texts;
  std::vector<double> numbers;
  std::vector<double> state;
};

Blueprint blueprint(WorldRecord& world);

/// A world of its own that is equal in everything. LoadError if a file is gone, ValueError if it has changed.
WorldRef build(const Blueprint& blueprint);

} // namespace pydart2
