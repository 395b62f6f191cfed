#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "contact/iterative_options.hpp"

namespace pydart2 {

/// Rows of contacts and constraints in blocks, and blocks in islands that share no velocity. With the numbers of
/// BoxedLcp: A x = b + w, where A = J Y' and Y' is M^-1 J', or what stands for both (TreeRows).
struct BlockSystem
{
  /// The rows of one contact or constraint, at one or two parts of the velocities.
  struct Block
  {
    std::array<int, 2> starts{0, 0}, sizes{0, 0}; ///< Of its parts.
    int row = 0, size = 0;
    std::size_t data = 0; ///< In `terms`: J and Y of the first part, of the second, W, its inverse.
    bool contact = false; ///< Its first row is normal, the others friction, whose bounds follow it.
    bool movable = false;
    double depth = 0.0; ///< m
    double force_mixing = 0.0; ///< What is added to W's diagonal, as a part of it.

    bool joins_as(const Block& other) const { return starts == other.starts && (sizes[1] == 0) == (other.sizes[1] == 0); }

    std::size_t numbers() const
    {
      return static_cast<std::size_t>(size * (2 * (sizes[0] + sizes[1]) + 2 * size));
    }
  };
  struct Island
  {
    int first = 0, last = 0; ///< Blocks.
    int row = 0, rows = 0, start = 0, size = 0; ///< Of the rows and velocities.
    bool calms = true; ///< Its bodies lose the speed that sweeps leave.
  };

  std::vector<Block> blocks; ///< One island after the other.
  std::vector<Island> islands;
  std::vector<double> terms;
  Eigen::VectorXd lo, hi, b;
  Eigen::VectorXd mixing; ///< The part of A's diagonal that is not M^-1.
  Eigen::VectorXd x, velocities;

  double* J(const Block& block, int part)
  {
    return terms.data() + block.data + static_cast<std::size_t>(part * 2 * block.size * block.sizes[0]);
  }
  double* Y(const Block& block, int part) { return J(block, part) + block.size * block.sizes[static_cast<std::size_t>(part)]; }
  double* W(const Block& block) { return J(block, 1) + 2 * block.size * block.sizes[1]; }
};

/// What the sweeps over an island came to.
struct Swept
{
  int sweeps = 0;
  double residual = 0.0;
  bool corrects = false; ///< Something is too deep.
};

/// Block Gauss-Seidel with projection (Moreau and Jean, as in Acary and Brogliato, Numerical Methods for Nonsmooth
/// Dynamical Systems, 2008, chapter 13): each constraint's rows are solved as a block, one after the other, and change
/// the velocities at once. After a sweep the impulses go on in the direction in which the sweeps take them, as in
/// conjugate gradients (Silcowitz, Niebe and Erleben, The Visual Computer 26, 2010).
class Sweeps
{
public:
  Sweeps(BlockSystem& system, const IterativeOptions& options)
    : system_(system), options_(options), velocities_(system.velocities.data())
  {
  }

  /// W of an island's blocks and what force mixing adds to it.
  void prepare(const BlockSystem::Island& island);

  /// From the impulses x on; x and the velocities are then those of the solution.
  Swept solve(const BlockSystem::Island& island);

  /// Velocities that take away, for one step, what is too deep: of the normal rows, and such that constraints without a
  /// limit of force keep what they hold. False, and zero, where nothing is too deep.
  bool find_corrections(const BlockSystem::Island& island, double time_step, Eigen::VectorXd& velocities);

private:
  using Block = BlockSystem::Block;
  using Island = BlockSystem::Island;

  template <int R, int A, int B>
  struct View;
  template <class Do>
  auto with_view(const Block& block, const Do& act);

  void begin(const Island& island);
  Swept sweep(const Island& island);
  double pass(const Island& island);
  double measure(const Island& island);
  double refine(const Island& island, double residual);

  template <class V, class Vector>
  void bounds(const V& view, int row, const Vector& x, double& lo, double& hi) const;
  template <class V, class Vector>
  void project(const V& view, Vector& x) const;
  template <class V>
  bool is_cone(const V& view) const;
  template <class V>
  double solve_block(V& view);
  template <class V, class Vector>
  void solve_inside(const V& view, const Vector& old, const Vector& w, Vector& y) const;
  template <class V>
  double residual_of(V& view) const;

  BlockSystem& system_;
  const IterativeOptions& options_;
  double* velocities_; ///< That the rows read and change.
  Eigen::VectorXd frozen_; ///< Normal impulses that bound friction; empty: those of the moment.
  int frozen_row_ = 0; ///< That of the first.
  Eigen::VectorXd along_x_, along_velocities_, last_x_, last_velocities_;
};

} // namespace pydart2
