#include "contact/iterative_options.hpp"

#include <algorithm>

#include "base/checks.hpp"
#include "base/errors.hpp"

namespace pydart2 {

Eigen::VectorXd numbers_of(const IterativeOptions& options)
{
  Eigen::VectorXd numbers(7);
  numbers << options.iterations, options.tolerance, static_cast<int>(options.friction), options.split,
      options.error_reduction, options.allowance, options.correction_speed;
  return numbers;
}

IterativeOptions options_of(const Eigen::VectorXd& numbers)
{
  if (numbers.size() != 8)
    check::size(numbers.size(), 7, "the options of the iterative solver");
  check::finite(VectorIn{numbers.data(), numbers.size()}, "the options of the iterative solver");
  const auto require = [](bool good, const char* what) {
    if (!good)
      throw Error(Kind::value, std::string("option ") + what);
  };
  require(numbers[0] >= 1.0 && numbers[0] <= 1e6, "'iterations' must be from 1 to 1,000,000");
  require(numbers[1] >= 0.0, "'tolerance' must not be negative");
  require(numbers[4] >= 0.0 && numbers[4] <= 1.0, "'error_reduction' must be from 0 to 1");
  require(numbers[5] >= 0.0, "'allowance' must not be negative");
  require(numbers[6] >= 0.0, "'correction_speed' must not be negative");
  IterativeOptions options;
  options.iterations = static_cast<int>(numbers[0]);
  options.tolerance = numbers[1];
  options.friction = static_cast<IterativeOptions::Friction>(static_cast<int>(numbers[2]));
  options.split = numbers[3] != 0.0;
  options.error_reduction = numbers[4];
  options.allowance = numbers[5];
  options.correction_speed = numbers[6];
  if (numbers.size() == 8) {
    require(numbers[7] > 0.0 && numbers[7] <= 256.0, "'threads' must be from 1 to 256");
    options.threads = std::max(1, static_cast<int>(numbers[7]));
  }
  return options;
}

} // namespace pydart2
