#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <dart/math/ConfigurationSpace.hpp>
#include <limits>
#include <utility>

/// The inverse of a joint's projected inertia, with the bits of dart::math::inverse.
namespace pydart2 {

/// Inverse of a positive definite matrix: Eigen's LDLT with its pivots (Golub and Van Loan, Matrix Computations, 4.2), and
/// its sums in its order, in panels of four rows, without its general loops.
class InverseOfSix
{
public:
  using Matrix = Eigen::Matrix<double, 6, 6>;

  static Matrix of(const Matrix& matrix) { return InverseOfSix(matrix).solve(); }

private:
  using Row = Eigen::Array<double, 1, 6>;

  explicit InverseOfSix(const Matrix& matrix) : L_(matrix)
  {
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      swaps_[k] = largest_from(k);
      if (swaps_[k] != k)
        exchange(k, swaps_[k]);
      eliminate(k);
      if (std::abs(L_(k, k)) > 0.0) {
        for (int i = k + 1; i < 6; ++i)
          L_(i, k) /= L_(k, k);
      } else if (k == 0) {
        swaps_ = {0, 1, 2, 3, 4, 5};
        return;
      }
    }
  }

  int largest_from(int k) const
  {
    int best = k;
    for (int i = k + 1; i < 6; ++i)
      if (std::abs(L_(i, i)) > std::abs(L_(best, best)))
        best = i;
    return best;
  }

  /// Rows and columns, of which the lower triangle counts.
  void exchange(int k, int other)
  {
    for (int i = 0; i < k; ++i)
      std::swap(L_(k, i), L_(other, i));
    for (int i = other + 1; i < 6; ++i)
      std::swap(L_(i, k), L_(i, other));
    std::swap(L_(k, k), L_(other, other));
    for (int i = k + 1; i < other; ++i)
      std::swap(L_(i, k), L_(other, i));
  }

  void eliminate(int k)
  {
    std::array<double, 6> sums{};
    for (int j = 0; j < k; ++j) {
      const double scaled = L_(j, j) * L_(k, j);
      for (int i = k; i < 6; ++i)
        sums[i] += L_(i, j) * scaled;
    }
    for (int i = k; i < 6 && k > 0; ++i)
      L_(i, k) -= sums[i];
  }

  Matrix solve()
  {
    for (int k = 0; k < 6; ++k)
      X_.row(k).swap(X_.row(swaps_[k]));
    for (int j = 0; j < 4; ++j)
      for (int i = j + 1; i < 4; ++i)
        X_.row(i) -= X_.row(j) * L_(i, j);
    for (int i = 4; i < 6; ++i)
      X_.row(i) -= sum(0, 4, [&](int j) { return L_(i, j); });
    X_.row(5) -= X_.row(4) * L_(5, 4);

    for (int i = 0; i < 6; ++i)
      if (std::abs(L_(i, i)) > std::numeric_limits<double>::min())
        X_.row(i) /= L_(i, i);
      else
        X_.row(i).setZero();

    for (int i = 4; i >= 2; --i)
      X_.row(i) -= sum(i + 1, 6, [&](int j) { return L_(j, i); });
    for (int i = 1; i >= 0; --i)
      X_.row(i) -= sum(2, 6, [&](int j) { return L_(j, i); });
    X_.row(0) -= X_.row(1) * L_(1, 0);
    for (int k = 5; k >= 0; --k)
      X_.row(k).swap(X_.row(swaps_[k]));
    return X_.matrix();
  }

  template <class Factor>
  Row sum(int first, int last, const Factor& factor)
  {
    Row result = Row::Zero();
    for (int j = first; j < last; ++j)
      result += X_.row(j) * factor(j);
    return result;
  }

  Matrix L_;                 ///< Below its diagonal; D on it.
  std::array<int, 6> swaps_; ///< Each row with that one, one after the other.
  Eigen::Array<double, 6, 6, Eigen::RowMajor> X_ = Matrix::Identity().array();
};

template <class Space>
typename Space::Matrix inverse_inertia(const typename Space::Matrix& projected)
{
  if constexpr (std::is_same_v<Space, dart::math::SE3Space>)
    return InverseOfSix::of(projected);
  else
    return dart::math::inverse<Space>(projected);
}

} // namespace pydart2
