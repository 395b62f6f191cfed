#include "contact/newton_steps.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pydart2 {

namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double nearness = 1e-8; // of the diagonal: rows that say the same stay near their impulses

} // namespace

NewtonSteps::NewtonSteps(BlockSystem& system, const BlockSystem::Island& island, bool cone, const Eigen::VectorXd& frozen)
  : system_(system), island_(island), cone_(cone), frozen_(frozen)
{
  RowMatrix J = RowMatrix::Zero(island.rows, island.size), Y = J;
  for (int i = island.first; i < island.last; ++i) {
    const auto& block = system.blocks[static_cast<std::size_t>(i)];
    for (const int part : {0, 1}) {
      const int size = block.sizes[static_cast<std::size_t>(part)];
      if (size == 0)
        continue;
      const int start = block.starts[static_cast<std::size_t>(part)] - island.start, row = block.row - island.row;
      J.block(row, start, block.size, size) = Eigen::Map<RowMatrix>(system.J(block, part), block.size, size);
      Y.block(row, start, block.size, size) = Eigen::Map<RowMatrix>(system.Y(block, part), block.size, size);
    }
  }
  A_.noalias() = J * Y.transpose();
  A_.diagonal() += system.mixing.segment(island.row, island.rows);
  for (int row = 0; row < island.rows; ++row) // what moves nothing keeps an impulse of nothing
    if (!(A_(row, row) > 0.0))
      A_(row, row) = 1.0;
}

void NewtonSteps::step()
{
  x_ = system_.x.segment(island_.row, island_.rows);
  w_ = A_ * x_ - system_.b.segment(island_.row, island_.rows);
  equations_.setIdentity(island_.rows, island_.rows);
  wanted_ = -x_;
  for (int i = island_.first; i < island_.last; ++i) {
    const auto& block = system_.blocks[static_cast<std::size_t>(i)];
    const int first = block.row - island_.row;
    for (int row = 0; row < (block.contact ? 1 : block.size); ++row) {
      const double y = x_[first + row] - w_[first + row] / A_(first + row, first + row);
      const double bounded = std::clamp(y, system_.lo[block.row + row], system_.hi[block.row + row]);
      wanted_[first + row] = bounded - x_[first + row];
      if (bounded == y)
        free_row(first + row);
    }
    if (block.contact && block.size == 3 && cone_)
      cone_rows(first);
    else if (block.contact)
      for (int row = 1; row < block.size; ++row)
        friction_row(first + row, first, system_.hi[block.row + row]);
  }
  system_.x.segment(island_.row, island_.rows) = x_ + equations_.partialPivLu().solve(wanted_);
}

/// Its velocity comes to what it should be.
void NewtonSteps::free_row(int row)
{
  equations_.row(row) = A_.row(row);
  equations_(row, row) *= 1.0 + nearness;
  wanted_[row] = -w_[row];
}

/// Of a pyramid: free, or at a bound that moves with the normal impulse.
void NewtonSteps::friction_row(int row, int normal, double most)
{
  const bool follows = frozen_.size() == 0;
  const double force = follows ? std::max(x_[normal], 0.0) : frozen_[normal];
  const double y = x_[row] - w_[row] / A_(row, row);
  if (std::abs(y) < most * force)
    return free_row(row);
  const double slope = std::copysign(most, y);
  wanted_[row] = slope * force - x_[row];
  if (follows)
    equations_(row, normal) = -slope;
}

/// Both tangents of a cone.
void NewtonSteps::cone_rows(int normal)
{
  const Eigen::Vector2d most = system_.hi.segment<2>(island_.row + normal + 1);
  const double force = std::max(x_[normal], 0.0);
  if (!(most.minCoeff() > 0.0))
    return; // stays at nothing
  const double scale = std::max(A_(normal + 1, normal + 1), A_(normal + 2, normal + 2)); // one: slip is against friction
  const Eigen::Vector2d x = x_.segment<2>(normal + 1), w = w_.segment<2>(normal + 1);
  const Eigen::Vector2d y = (x - w / scale).cwiseQuotient(most);
  const double out = y.norm();
  if (out < force) {
    free_row(normal + 1);
    free_row(normal + 2);
    return;
  }
  const Eigen::Vector2d along = out > 0.0 ? Eigen::Vector2d(y / out) : Eigen::Vector2d::Zero();
  if (out > 0.0) { // how the direction turns with x
    const Eigen::Matrix2d turn = force / out * (most.asDiagonal() * (Eigen::Matrix2d::Identity() - along * along.transpose())
                                                * most.cwiseInverse().asDiagonal());
    RowMatrix slopes = A_.middleRows(normal + 1, 2) / -scale;
    slopes.middleCols(normal + 1, 2) += Eigen::Matrix2d::Identity();
    equations_.middleRows(normal + 1, 2) -= turn * slopes;
  }
  equations_.block<2, 1>(normal + 1, normal) -= most.cwiseProduct(along);
  wanted_.segment<2>(normal + 1) = force * most.cwiseProduct(along) - x;
}

} // namespace pydart2
