// loop STEPS REPEATS SCENE... (as for loop_make): prints the seconds of CPU time of one step (the least of REPEATS times
// STEPS steps from the same state), and those on the wall (of all of them).

#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <string>

struct Loop;
extern "C" Loop* loop_make(int count, const char* const* arguments);
extern "C" void loop_restart(Loop* loop);
extern "C" double loop_steps(Loop* loop, int count);
extern "C" void loop_delete(Loop* loop);

int main(int argc, char** argv)
{
  if (argc < 4)
    return 1;
  const int steps = std::stoi(argv[1]), repeats = std::stoi(argv[2]);
  Loop* loop = loop_make(argc - 3, argv + 3);
  double least = std::numeric_limits<double>::infinity();
  const auto first = std::chrono::steady_clock::now();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    loop_restart(loop);
    least = std::min(least, loop_steps(loop, steps));
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - first;
  loop_delete(loop);
  std::cout << least / steps << " " << wall.count() / steps / repeats << "\n";
}
