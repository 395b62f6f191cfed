#include "state/state_vector.hpp"

#include "state/sleeping.hpp"

namespace pydart2 {

long num_states(const WorldRecord& world)
{
  long size = 0;
  for (const auto& record : world.skeletons)
    size += 2 * static_cast<long>(record->skeleton->getNumDofs());
  return size;
}

void write_states(const WorldRecord& world, double* out)
{
  for (const auto& record : world.skeletons) {
    const DofState& dofs = record->dofs();
    for (const auto* places : {&dofs.positions, &dofs.velocities})
      for (const double* place : *places)
        *out++ = *place;
  }
}

void read_states(WorldRecord& world, const double* in)
{
  wake_all(world);
  world.become_numbers();
  for (const auto& record : world.skeletons) {
    auto& skeleton = *record->skeleton;
    const auto n = static_cast<long>(skeleton.getNumDofs());
    if (Eigen::Map<const Eigen::VectorXd>(in, 2 * n).hasNaN()) // a recorded frame of a blow-up
      world.become_not_numbers(*record);
    else {
      skeleton.setPositions(Eigen::Map<const Eigen::VectorXd>(in, n));
      skeleton.setVelocities(Eigen::Map<const Eigen::VectorXd>(in + n, n));
    }
    in += 2 * n;
  }
}

} // namespace pydart2
