#include "engine/collision_filter.hpp"

#include <dart/dynamics/ShapeNode.hpp>
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

using dart::collision::CollisionResult;
using Contacts = std::vector<dart::collision::Contact>;

Contacts& contacts_in(CollisionResult& result);

template <Contacts CollisionResult::* contacts>
struct RevealContacts
{
  friend Contacts& contacts_in(CollisionResult& result) { return result.*contacts; }
};
template struct RevealContacts<&CollisionResult::mContacts>;

struct NodeMembers : dart::dynamics::Node
{
  static constexpr auto body = &NodeMembers::mBodyNode;
};

/// Null for what is no shape of a body.
const dart::dynamics::BodyNode* body_of(const dart::collision::CollisionObject& object)
{
  const auto* node = object.getShapeFrame()->asShapeNode();
  return node == nullptr ? nullptr : node->*NodeMembers::body;
}

struct BodyMembers : dart::dynamics::BodyNode
{
  static constexpr auto skeleton = &BodyMembers::mSkeleton;
};

bool is_in(const dart::dynamics::BodyNode& body, const dart::dynamics::ConstSkeletonPtr& skeleton)
{
  const auto& its = body.*BodyMembers::skeleton;
  return !its.owner_before(skeleton) && !skeleton.owner_before(its);
}

} // namespace

std::vector<dart::collision::Contact>& contacts_of(CollisionResult& result)
{
  return contacts_in(result);
}

bool may_collide(const BitsOfBodies& bits, const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b)
{
  const auto of = [&](const dart::dynamics::BodyNode& body) {
    const auto found = bits.find(&body);
    return found == bits.end() ? CollisionBits() : found->second;
  };
  const auto first = of(a), second = of(b);
  return (first.mask & second.group) != 0 && (second.mask & first.group) != 0;
}

bool BodyFilter::ignoresCollision(
    const dart::collision::CollisionObject* object1, const dart::collision::CollisionObject* object2) const
{
  const auto *a = body_of(*object1), *b = body_of(*object2);
  if (a == nullptr || b == nullptr)
    return BodyNodeCollisionFilter::ignoresCollision(object1, object2);
  if (!bits_.empty() && !may_collide(bits_, *a, *b))
    return true;
  const auto skeleton = a->getSkeleton();
  if (is_in(*b, skeleton)) {
    if (!skeleton->isEnabledSelfCollisionCheck())
      return true;
  } else if (
      a->isCollidable() && b->isCollidable() && !ignored_pairs(*this).contains(a, b)
      && (skeleton->isMobile() || b->getSkeleton()->isMobile())) {
    return false;
  }
  return BodyNodeCollisionFilter::ignoresCollision(object1, object2);
}

PairFilter::PairFilter(const dart::collision::CollisionFilter* filter) : none_(filter == nullptr)
{
  if (none_)
    return;
  const bool is_ours = typeid(*filter) == typeid(BodyFilter);
  if (is_ours || typeid(*filter) == typeid(BodyNodeCollisionFilter))
    ignored_ = &ignored_pairs(static_cast<const BodyNodeCollisionFilter&>(*filter));
  if (is_ours && !static_cast<const BodyFilter&>(*filter).bits().empty())
    bits_ = &static_cast<const BodyFilter&>(*filter).bits();
}

bool PairFilter::surely_collide(const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b) const
{
  if (none_)
    return true;
  return ignored_ != nullptr && !is_told_to_ignore(a, b);
}

bool PairFilter::is_told_to_ignore(const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b) const
{
  return (ignored_ != nullptr && ignored_->contains(&a, &b)) || (bits_ != nullptr && !may_collide(*bits_, a, b));
}

} // namespace pydart2::engine
