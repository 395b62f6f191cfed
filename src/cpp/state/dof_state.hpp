#pragma once

#include <dart/dynamics/Skeleton.hpp>
#include <vector>

namespace pydart2 {

/// Where the engine keeps the position, velocity, acceleration and force of each dof, in the order of the dofs. Reading there
/// costs a tenth of asking dof after dof. Valid until the tree changes.
struct DofState
{
  explicit DofState(const dart::dynamics::Skeleton& skeleton);

  std::size_t size() const { return positions.size(); }

  /// From now on all places but the forces' hold NaN.
  void become_not_numbers();

  /// Whether Skeleton::resetCommands() would change nothing.
  bool commands_at_rest() const;

  std::vector<const double*> positions, velocities, accelerations, forces;

private:
  struct JointCommands
  {
    const dart::dynamics::Joint* joint;
    bool (*at_rest)(const dart::dynamics::Joint&);
  };
  std::vector<JointCommands> joints_;
};

} // namespace pydart2
