#pragma once

#include <Eigen/Core>

namespace pydart2 {

/// A boxed complementarity problem as it was before a solver overwrote it, and how far impulses are from solving it:
/// A x = b + w, lo <= x <= hi, where the bounds of a friction row are parts of the impulse of row findex.
class ExactResidual
{
public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  void keep(
      const Matrix& A, const Eigen::VectorXd& b, const Eigen::VectorXd& lo, const Eigen::VectorXd& hi,
      const Eigen::VectorXi& findex);

  /// The problem once more.
  void give(Matrix& A, Eigen::VectorXd& b, Eigen::VectorXd& lo, Eigen::VectorXd& hi, Eigen::VectorXi& findex) const;

  /// The largest A_ii |x_i - P(x_i - w_i / A_ii)| over the rows, P the projection on the bounds.
  double of(const Eigen::VectorXd& x);

private:
  Matrix A_;
  Eigen::VectorXd b_, lo_, hi_, w_;
  Eigen::VectorXi findex_;
};

} // namespace pydart2
