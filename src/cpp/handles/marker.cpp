#include "handles/marker.hpp"

#include <dart/dynamics/BodyNode.hpp>

#include "base/checks.hpp"

namespace pydart2 {

MarkerHandle::MarkerHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::Marker* marker)
  : marker_(std::move(world), std::move(skeleton), marker)
{
}

std::string MarkerHandle::name() const
{
  return marker_->getName();
}

int MarkerHandle::bodynode() const
{
  return static_cast<int>(marker_->getBodyNodePtr()->getIndexInSkeleton());
}

Eigen::Vector3d MarkerHandle::local_position() const
{
  return marker_->getLocalPosition();
}

void MarkerHandle::set_local_position(const Eigen::Vector3d& position)
{
  check::finite(position, "local position");
  marker_->setLocalPosition(position);
}

Eigen::Vector3d MarkerHandle::world_position() const
{
  return marker_->getWorldPosition();
}

} // namespace pydart2
