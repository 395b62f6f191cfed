#pragma once

#include <Eigen/Core>
#include <vector>

namespace pydart2 {

/// Solves a boxed linear complementarity problem with friction, as described in warm_lcp.hpp, by Dantzig's principal
/// pivoting (Cottle and Dantzig, Linear Algebra and its Applications 1, 1968; for contacts Baraff, SIGGRAPH 1994): rows
/// are taken in one by one, and while one is driven to its solution, the rows before it keep theirs. Rows between their
/// bounds, the clamped ones, have w = 0; of their part of A the factors L D L' are kept and updated.
///
/// The solution is bitwise that of the engine's DantzigBoxedLcpSolver, which is ODE's: the same pivots, the same sums in
/// the same order. ODE goes element by element through rows of L. Here L is stored by columns, so that the rows of a
/// column go through the processor two by two, and dot products are formed four at a time.
class DantzigLcp
{
public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// The lower triangle of A counts; its columns may be more than its rows. Everything but x is used up. False, with x
  /// undefined, where a row cannot be driven further.
  bool solve(
      Matrix& A, Eigen::VectorXd& x, Eigen::VectorXd& b, Eigen::VectorXd& lo, Eigen::VectorXd& hi, Eigen::VectorXi& findex);

private:
  /// How a step of a driven row ends.
  enum class End { solved, at_lower, at_upper, clamp, release_at_lower, release_at_upper };
  struct Step
  {
    double length;
    End end;
    int row;
  };

  /// Of a row with the elements a at the clamped rows: L^-1 a, and D^-1 L^-1 a.
  struct Column
  {
    std::vector<double> values, scaled;
  };

  void begin(Matrix& A);
  void put_free_rows_first();
  void put_friction_last();
  void bound_friction(int from);
  bool drive(int row);
  Step longest_step(int row, double direction);
  void stay(int row, double side);
  void clamp(int row, const Column& column);
  int release(int row);

  void find_column(int row, int known, Column& column);
  void find_direction(double sign);
  void find_response(int row, double direction);
  void factor(int row, const Column& column);
  void remove_factor(int index);
  void update_factors(int first);
  void swap_rows(int row1, int row2);

  static double dot(const double* a, const double* b, int size)
  {
    double sum = 0.0;
    for (int i = 0; i < size; ++i)
      sum += a[i] * b[i];
    return sum;
  }
  double& L(int row, int column) { return L_[column * stride_ + row]; }
  double A(int row, int column) const { return row > column ? A_[row][column] : A_[column][row]; }

  // Rows are in the order: clamped, at a bound, not yet taken in. `original_` are their numbers as they came.
  int size_ = 0, num_free_ = 0, num_clamped_ = 0, num_bound_ = 0;
  std::vector<double*> A_; ///< Of each row the elements up to the diagonal.
  double *x_ = nullptr, *b_ = nullptr, *lo_ = nullptr, *hi_ = nullptr;
  int* findex_ = nullptr;
  std::vector<double> w_, dx_, dw_;
  std::vector<double> side_; ///< Of a row at a bound: 1 upper, -1 lower, 0 if it has no way to go.
  std::vector<int> original_;

  // Factors of the clamped rows in the order in which they came; L without its diagonal, D inverted.
  std::ptrdiff_t stride_ = 0;
  std::vector<double> L_, inverse_D_, sums_, first_, second_;
  std::vector<int> clamped_; ///< Rows of the factors.
  Column driven_, other_;
};

} // namespace pydart2
