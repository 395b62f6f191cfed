// loop STEPS REPEATS THREADS SCENE... (as for loop_make): prints the seconds of CPU time of one step (the least of REPEATS
// times STEPS steps from the same state), and those on the wall (of all of them). Each thread has a world of its own.

#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "loop.hpp"

int main(int argc, char** argv)
{
  if (argc < 5)
    return 1;
  const int steps = std::stoi(argv[1]), repeats = std::stoi(argv[2]), threads = std::stoi(argv[3]);
  std::vector<std::unique_ptr<Loop>> loops;
  for (int i = 0; i < threads; ++i)
    loops.emplace_back(loop_make(argc - 4, argv + 4));
  double least = std::numeric_limits<double>::infinity();
  const auto play = [&](Loop* loop) {
    for (int repeat = 0; repeat < repeats; ++repeat) {
      loop_restart(loop);
      const double seconds = loop_steps(loop, steps);
      if (loop == loops.front().get())
        least = std::min(least, seconds);
    }
  };
  const auto first = std::chrono::steady_clock::now();
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i)
    others.emplace_back(play, loops[i].get());
  play(loops.front().get());
  for (auto& thread : others)
    thread.join();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - first;
  std::cout << least / steps << " " << wall.count() / steps / repeats << "\n";
}
