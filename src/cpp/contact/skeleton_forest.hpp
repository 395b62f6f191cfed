#pragma once

#include <dart/dynamics/Skeleton.hpp>

#include "base/lookup.hpp"

namespace pydart2 {

/// Which skeletons contacts join: the forest that the engine makes of them, one contact after the other, with the same
/// branches.
class SkeletonForest
{
public:
  using Skeleton = dart::dynamics::Skeleton;

  void clear() { nodes_.clear(); }
  void join(const Skeleton* a, const Skeleton* b);
  const Skeleton* root(const Skeleton* skeleton) const;

  /// The skeleton itself if it is a root. Here the engine ends its search for the group of a joint's constraint.
  const Skeleton* above(const Skeleton* skeleton) const
  {
    const auto* node = nodes_.find(skeleton);
    return node == nullptr ? skeleton : node->above;
  }

private:
  struct Node
  {
    const Skeleton* above;
    int size; ///< Of the tree below a root.
  };

  const Skeleton* shorten(const Skeleton* skeleton);

  Lookup<Skeleton, Node> nodes_;
};

} // namespace pydart2
