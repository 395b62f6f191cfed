#pragma once

#include <Eigen/Core>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Marker.hpp>
#include <string>

#include "handles/part.hpp"

namespace pydart2 {

/// dart::dynamics::Marker: a named point of a body.
class MarkerHandle
{
public:
  MarkerHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::Marker* marker);

  std::string name() const;
  int bodynode() const;
  Eigen::Vector3d local_position() const;
  void set_local_position(const Eigen::Vector3d& position);
  Eigen::Vector3d world_position() const;

private:
  Part<dart::dynamics::Marker, NodeOwner<dart::dynamics::Marker>> marker_;
};

} // namespace pydart2
