#pragma once

#include <Eigen/Core>
#include <vector>

namespace pydart2 {

/// A boxed linear complementarity problem with friction: A x = b + w, where a row is at its lower bound with w >= 0, at
/// its upper bound with w <= 0, or between them with w = 0. A friction row i has the bounds -mu |x_j| and mu |x_j| with
/// j = findex[i], where x_j is the solution without friction, as in ODE's solver.
struct BoxedLcp
{
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  const Matrix& A; ///< Symmetric and positive definite; its columns may be more than its rows.
  const Eigen::VectorXd &b, &lo, &hi;
  const Eigen::VectorXi& findex; ///< -1 in rows that are not of friction.
};

/// Solves it by guessing which rows are at which bound, first as in the step before, then, with all that is wrong put
/// right at once, until nothing is wrong any more (block principal pivoting: Judice and Pires, Computers & Operations
/// Research 21, 1994). A right guess costs one Cholesky factorisation. The solution is that of ODE's solver to rounding.
/// Where the guesses do not become right, the next tries are put off for twice as many steps each time.
class WarmLcp
{
public:
  /// Solves the problem of a group of constraints; false if the guesses have not become right or are put off.
  bool solve(std::size_t group, const BoxedLcp& lcp, Eigen::VectorXd& x);

  /// Forgets the steps before.
  void forget() { memories_.clear(); }

  /// What it remembers: of each group for how many steps it is put off, how many it was put off the last time, how many
  /// rows there were, and where they were without friction and with it.
  std::vector<double> memory() const;

  /// Takes that back; false, and nothing changes, if these are other numbers.
  bool remember(const std::vector<double>& memory);

private:
  enum class Place : char { between, low, high };

  /// Of one group.
  struct Memory
  {
    int put_off = 0, last_put_off = 0; ///< Steps.
    std::vector<Place> normal, all;    ///< Where the rows were, without friction and with it.
  };

  bool guess(const BoxedLcp& lcp, Memory& memory, Eigen::VectorXd& x);
  bool pivot(
      const BoxedLcp& lcp, const Eigen::VectorXd& lo, const Eigen::VectorXd& hi, const std::vector<int>& rows,
      std::vector<Place>& places, Eigen::VectorXd& x);
  bool solve_between(const BoxedLcp& lcp, const std::vector<int>& rows, const std::vector<Place>& places, Eigen::VectorXd& x);

  std::vector<Memory> memories_; // of each group, in the order of the groups
  std::vector<int> between_;
  Eigen::MatrixXd factor_;
  Eigen::VectorXd right_, lo_, hi_;
};

} // namespace pydart2
