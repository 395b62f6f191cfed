#include "engine/collision_filter.hpp"

#include <typeinfo>

namespace pydart2::engine {

namespace {

using dart::collision::BodyNodeCollisionFilter;
using Pairs = dart::collision::detail::UnorderedPairs<dart::dynamics::BodyNode>;

const Pairs& ignored_pairs(const BodyNodeCollisionFilter& filter);

// An explicit instantiation may name private members, as in engine_access.cpp.
template <Pairs BodyNodeCollisionFilter::* pairs>
struct Reveal
{
  friend const Pairs& ignored_pairs(const BodyNodeCollisionFilter& filter) { return filter.*pairs; }
};
template struct Reveal<&BodyNodeCollisionFilter::mBodyNodeBlackList>;

} // namespace

PairFilter::PairFilter(const dart::collision::CollisionFilter* filter) : none_(filter == nullptr)
{
  if (!none_ && typeid(*filter) == typeid(BodyNodeCollisionFilter))
    ignored_ = &ignored_pairs(static_cast<const BodyNodeCollisionFilter&>(*filter));
}

bool PairFilter::surely_collide(const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b) const
{
  if (none_)
    return true;
  return ignored_ != nullptr && a.isCollidable() && b.isCollidable() && !ignored_->contains(&a, &b);
}

} // namespace pydart2::engine
