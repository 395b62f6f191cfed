#pragma once

#include <string>
#include <vector>

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

} // namespace pydart2
