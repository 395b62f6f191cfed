#include "contact/exact_residual.hpp"

#include <algorithm>
#include <cmath>

namespace pydart2 {

void ExactResidual::keep(
    const Matrix& A, const Eigen::VectorXd& b, const Eigen::VectorXd& lo, const Eigen::VectorXd& hi,
    const Eigen::VectorXi& findex)
{
  A_ = A;
  b_ = b;
  lo_ = lo;
  hi_ = hi;
  findex_ = findex;
}

void ExactResidual::give(
    Matrix& A, Eigen::VectorXd& b, Eigen::VectorXd& lo, Eigen::VectorXd& hi, Eigen::VectorXi& findex) const
{
  A = A_;
  b = b_;
  lo = lo_;
  hi = hi_;
  findex = findex_;
}

double ExactResidual::of(const Eigen::VectorXd& x)
{
  w_.noalias() = A_.leftCols(x.size()) * x;
  w_ -= b_;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double diagonal = A_(i, i);
    if (!(diagonal > 0.0))
      continue;
    const double scale = findex_[i] < 0 ? 1.0 : std::abs(x[findex_[i]]);
    const double lo = findex_[i] < 0 ? lo_[i] : lo_[i] * scale, hi = findex_[i] < 0 ? hi_[i] : hi_[i] * scale;
    const double projected = std::min(std::max(x[i] - w_[i] / diagonal, lo), hi);
    largest = std::max(largest, diagonal * std::abs(x[i] - projected));
  }
  return largest;
}

} // namespace pydart2
