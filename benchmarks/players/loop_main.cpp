// loop STEPS REPEATS SCENE... (as for loop_make): prints the seconds of CPU time of one step (the least of REPEATS times
// STEPS steps from the same state), and those on the wall (of all of them).

#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "loop.hpp"

int main(int argc, char** argv)
{
  if (argc < 4)
    return 1;
  const int steps = std::stoi(argv[1]), repeats = std::stoi(argv[2]);
  const std::unique_ptr<Loop> loop(loop_make(argc - 3, argv + 3));
  double least = std::numeric_limits<double>::infinity();
  const auto first = std::chrono::steady_clock::now();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    loop_restart(loop.get());
    least = std::min(least, loop_steps(loop.get(), steps));
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - first;
  std::cout << least / steps << " " << wall.count() / steps / repeats << "\n";
}
