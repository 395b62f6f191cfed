#pragma once

#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/dynamics/BodyNode.hpp>

/// The engine's filter of pairs of bodies takes 2 µs a pair, most of it for counting references. For bodies of different
/// skeletons this asks the same questions without; of the engine's private members it relies on
/// BodyNodeCollisionFilter::mBodyNodeBlackList, and does not compile where that has another name or type.
namespace pydart2::engine {

class PairFilter
{
public:
  explicit PairFilter(const dart::collision::CollisionFilter* filter);

  /// Whether a filter is sure to let the bodies collide; what it says else is to be asked of the filter itself.
  bool surely_collide(const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b) const;

private:
  using Pairs = dart::collision::detail::UnorderedPairs<dart::dynamics::BodyNode>;

  bool none_ = false; ///< There is no filter.
  const Pairs* ignored_ = nullptr; ///< Null: some other filter.
};

} // namespace pydart2::engine
