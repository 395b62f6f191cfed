#include "contact/skeleton_forest.hpp"

#include <utility>

namespace pydart2 {

void SkeletonForest::join(const Skeleton* a, const Skeleton* b)
{
  if (a == b)
    return;
  nodes_.try_emplace(a, {a, 1});
  nodes_.try_emplace(b, {b, 1});
  a = shorten(a);
  b = shorten(b);
  if (a == b)
    return;
  auto *above = nodes_.find(a), *below = nodes_.find(b);
  if (above->size < below->size)
    std::swap(above, below);
  above->size += below->size;
  below->above = above->above;
}

const SkeletonForest::Skeleton* SkeletonForest::root(const Skeleton* skeleton) const
{
  for (const Skeleton* next = above(skeleton); next != skeleton; next = above(skeleton))
    skeleton = next;
  return skeleton;
}

/// The root; each second node on the way is hung up one higher.
const SkeletonForest::Skeleton* SkeletonForest::shorten(const Skeleton* skeleton)
{
  while (above(skeleton) != skeleton)
    skeleton = nodes_.find(skeleton)->above = above(above(skeleton));
  return skeleton;
}

} // namespace pydart2
