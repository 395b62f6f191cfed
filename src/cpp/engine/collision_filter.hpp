#pragma once

#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/CollisionResult.hpp>
#include <cstdint>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <unordered_map>

/// The engine's filter of pairs of bodies spends most of its time on counting references. What is here asks the same
/// questions without, where one answer settles it; of the engine's private members it relies on
/// BodyNodeCollisionFilter::mBodyNodeBlackList, and does not compile where that has another name or type.
namespace pydart2::engine {

/// Two bodies collide only where each's mask has a bit of the other's group.
struct CollisionBits
{
  std::uint32_t group = 1;
  std::uint32_t mask = 0xffffffff;

  bool usual() const { return group == 1 && mask == 0xffffffff; }
};

/// Of the bodies whose bits are not those of all.
using BitsOfBodies = std::unordered_map<const dart::dynamics::BodyNode*, CollisionBits>;

bool may_collide(const BitsOfBodies& bits, const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b);

/// The engine's filter with the bits, in less time.
class BodyFilter : public dart::collision::BodyNodeCollisionFilter
{
public:
  explicit BodyFilter(BitsOfBodies bits = {}) : bits_(std::move(bits)) {}

  bool ignoresCollision(
      const dart::collision::CollisionObject* object1, const dart::collision::CollisionObject* object2) const override;
  const BitsOfBodies& bits() const { return bits_; }

private:
  BitsOfBodies bits_;
};

class PairFilter
{
public:
  explicit PairFilter(const dart::collision::CollisionFilter* filter);

  /// Whether a filter is sure to let two bodies collide, both of which are collidable; what it says else is to be asked
  /// of the filter itself.
  bool surely_collide(const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b) const;

  /// Whether a filter is sure to let all bodies of a skeleton pass through each other.
  bool surely_ignores_within(const dart::dynamics::Skeleton& skeleton) const
  {
    return ignored_ != nullptr && !skeleton.isEnabledSelfCollisionCheck();
  }

  /// Whether the pair or its bits say that the bodies pass through each other.
  bool is_told_to_ignore(const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b) const;

private:
  using Pairs = dart::collision::detail::UnorderedPairs<dart::dynamics::BodyNode>;

  bool none_ = false; ///< There is no filter.
  const Pairs* ignored_ = nullptr; ///< Null: some other filter.
  const BitsOfBodies* bits_ = nullptr; ///< Null: all collide.
};

/// The contacts of a result, without the sets of what touches, which CollisionResult::addContact() fills at some cost and
/// nothing here reads.
std::vector<dart::collision::Contact>& contacts_of(dart::collision::CollisionResult& result);

} // namespace pydart2::engine
