#pragma once

#include <dart/constraint/ConstraintBase.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <vector>

namespace pydart2 {

/// Joints that may have rows, of limits, servos, mimics or dry friction, and the skeletons that have such.
struct Jointed
{
  void look_at(const std::vector<dart::dynamics::SkeletonPtr>& all);

  /// The engine's, in its order.
  std::vector<dart::constraint::ConstraintBasePtr> make_constraints() const;

  std::vector<dart::dynamics::SkeletonPtr> skeletons;
  std::vector<dart::dynamics::Joint*> joints;
};

} // namespace pydart2
