#pragma once

#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

/// While one lives in this thread, the matrices of a skeleton that gets a body stay as they are. The engine makes all eight
/// anew for each body, n by n numbers each, so that the time to read a chain goes with the cube of its links.
class LateSizes
{
public:
  LateSizes();
  ~LateSizes();
  LateSizes(const LateSizes&) = delete;
  LateSizes& operator=(const LateSizes&) = delete;

  /// Makes the matrices of a skeleton, once.
  static void give(dart::dynamics::Skeleton& skeleton);
};

} // namespace pydart2
