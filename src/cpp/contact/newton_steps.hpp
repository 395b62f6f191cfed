#pragma once

#include <Eigen/Core>

#include "contact/block_system.hpp"

namespace pydart2 {

/// Newton's method on x = P(x - w / W), with W the diagonal of A and P the projection on bounds that follow x (Alart and
/// Curnier, Computer Methods in Applied Mechanics and Engineering 92, 1991), for the rows of one island. It does not mind
/// a gram below a ton, where sweeps take as many rounds as the masses are apart; but its matrix is that of all rows.
class NewtonSteps
{
public:
  static constexpr int most_rows = 120;

  /// `frozen` normal impulses that bound friction; empty: those of the moment.
  NewtonSteps(BlockSystem& system, const BlockSystem::Island& island, bool cone, const Eigen::VectorXd& frozen);

  /// One step from the impulses of the system, which are then new, and may be beyond their bounds.
  void step();

private:
  using Block = BlockSystem::Block;

  void free_row(int row);
  void friction_row(int row, int normal, double most);
  void cone_rows(int normal);

  BlockSystem& system_;
  const BlockSystem::Island& island_;
  const bool cone_;
  const Eigen::VectorXd& frozen_;
  Eigen::MatrixXd A_, equations_;
  Eigen::VectorXd x_, w_, wanted_;
};

} // namespace pydart2
