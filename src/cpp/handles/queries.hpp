#pragma once

#include "collision/native_ray_scene.hpp"
#include "handles/world.hpp"

namespace pydart2 {

/// Questions about the shapes of a world as they stand. They change nothing.
class QueriesHandle
{
public:
  explicit QueriesHandle(const WorldHandle& world);

  /// A row for each ray: distance (infinite for none), point, normal, and the indices of skeleton, body and shape (-1).
  void raycast(const MatrixIn& origins, const MatrixIn& directions, double max_distance, Output& out);

private:
  WorldRef world_;
  native::RayScene rays_;
};

} // namespace pydart2
