#include "contact/dantzig_lcp.hpp"

#include <algorithm>
#include <cmath>
#include <dart/external/odelcpsolver/matrix.h>
#include <limits>

namespace pydart2 {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

bool DantzigLcp::solve(
    Matrix& A, Eigen::VectorXd& x, Eigen::VectorXd& b, Eigen::VectorXd& lo, Eigen::VectorXd& hi, Eigen::VectorXi& findex)
{
  x.setZero();
  x_ = x.data();
  b_ = b.data();
  lo_ = lo.data();
  hi_ = hi.data();
  findex_ = findex.data();
  begin(A);
  put_free_rows_first();
  put_friction_last();
  bool friction_bounded = false;
  for (int row = num_free_; row < size_; ++row) {
    if (!friction_bounded && findex_[row] >= 0) {
      bound_friction(row);
      friction_bounded = true;
    }
    const int n = num_clamped_;
    w_[row] = dot(A_[row], x_, n) + dot(A_[row] + n, x_ + n, num_bound_) - b_[row];
    if (lo_[row] == 0.0 && w_[row] >= 0.0) {
      stay(row, -1.0);
      ++num_bound_;
    } else if (hi_[row] == 0.0 && w_[row] <= 0.0) {
      stay(row, 1.0);
      ++num_bound_;
    } else if (w_[row] == 0.0) {
      find_column(row, 0, driven_);
      clamp(row, driven_);
    } else if (!drive(row))
      return false;
  }
  std::copy(x_, x_ + size_, sums_.begin());
  for (int row = 0; row < size_; ++row)
    x[original_[row]] = sums_[row];
  return true;
}

void DantzigLcp::begin(Matrix& A)
{
  size_ = static_cast<int>(A.rows());
  num_free_ = num_clamped_ = num_bound_ = 0;
  const auto size = static_cast<std::size_t>(size_);
  A_.resize(size);
  original_.resize(size);
  for (int row = 0; row < size_; ++row) {
    A_[row] = A.row(row).data();
    original_[row] = row;
  }
  for (auto* numbers : {&w_, &side_, &dx_, &dw_, &inverse_D_, &sums_, &first_, &second_, &driven_.values, &driven_.scaled,
                        &other_.values, &other_.scaled})
    numbers->resize(size);
  clamped_.resize(size);
  stride_ = (size_ + 1) / 2 * 2 + 2;
  L_.resize(size * static_cast<std::size_t>(stride_));
}

/// Rows without bounds, as of joints that hold bodies together, are solved at once and never released.
void DantzigLcp::put_free_rows_first()
{
  for (int row = 0; row < size_; ++row)
    if (findex_[row] < 0 && lo_[row] == -infinity && hi_[row] == infinity)
      swap_rows(num_free_++, row);
  if (num_free_ == 0)
    return;
  Matrix part(num_free_, dPAD(num_free_));
  for (int row = 0; row < num_free_; ++row)
    std::copy(A_[row], A_[row] + row + 1, part.row(row).data());
  const auto columns = static_cast<int>(part.cols());
  dart::external::ode::dFactorLDLT(part.data(), inverse_D_.data(), num_free_, columns);
  std::copy(b_, b_ + num_free_, x_);
  dart::external::ode::dSolveLDLT(part.data(), inverse_D_.data(), x_, num_free_, columns);
  for (int row = 0; row < num_free_; ++row) {
    w_[row] = 0.0;
    clamped_[row] = row;
    for (int column = 0; column < row; ++column)
      L(row, column) = part(row, column);
  }
  num_clamped_ = num_free_;
}

/// The bounds of friction depend on the normal forces.
void DantzigLcp::put_friction_last()
{
  int last = size_;
  for (int row = size_ - 1; row >= num_free_; --row)
    if (findex_[row] >= 0)
      swap_rows(row, --last);
}

void DantzigLcp::bound_friction(int from)
{
  for (int row = 0; row < size_; ++row)
    sums_[original_[row]] = x_[row];
  for (int row = from; row < size_; ++row) {
    const double normal = sums_[findex_[row]];
    hi_[row] = normal == 0.0 ? 0.0 : std::abs(hi_[row] * normal);
    lo_[row] = normal == 0.0 ? 0.0 : -hi_[row];
  }
}

/// Drives x of a row until it is at a bound or its w is zero; rows before it change sides where they must.
bool DantzigLcp::drive(int row)
{
  for (int known = 0;;) {
    const double direction = w_[row] <= 0.0 ? 1.0 : -1.0;
    find_column(row, known, driven_);
    find_direction(-direction);
    find_response(row, direction);
    const auto step = longest_step(row, direction);
    if (step.length <= 0.0)
      return false;

    for (int i = 0; i < num_clamped_; ++i)
      x_[i] += step.length * dx_[i];
    x_[row] += step.length * direction;
    for (int i = num_clamped_; i < num_clamped_ + num_bound_; ++i)
      w_[i] += step.length * dw_[i];
    w_[row] += step.length * dw_[row];

    const int other = step.row;
    switch (step.end) {
      case End::solved:
        w_[row] = 0.0;
        clamp(row, driven_);
        return true;
      case End::at_lower:
      case End::at_upper:
        stay(row, step.end == End::at_upper ? 1.0 : -1.0);
        x_[row] = step.end == End::at_upper ? hi_[row] : lo_[row];
        ++num_bound_;
        return true;
      case End::clamp:
        w_[other] = 0.0;
        known = num_clamped_;
        find_column(other, 0, other_);
        clamp(other, other_);
        --num_bound_;
        break;
      case End::release_at_lower:
      case End::release_at_upper:
        stay(other, step.end == End::release_at_upper ? 1.0 : -1.0);
        x_[other] = step.end == End::release_at_upper ? hi_[other] : lo_[other];
        known = release(other);
        break;
    }
  }
}

void DantzigLcp::stay(int row, double side)
{
  side_[row] = lo_[row] == 0.0 && hi_[row] == 0.0 ? 0.0 : side;
}

/// All lengths first, two at a time, also those of rows that go the other way; then one test for each, which hardly ever
/// holds. Which way a row goes no processor guesses.
DantzigLcp::Step DantzigLcp::longest_step(int row, double direction)
{
  const int n = num_clamped_, end = n + num_bound_;
  double* __restrict lengths = sums_.data();
  const double *x = x_, *lo = lo_, *hi = hi_, *w = w_.data(), *dx = dx_.data(), *dw = dw_.data(), *side = side_.data();
  for (int i = num_free_; i < n; ++i) {
    const double low = lo[i], high = hi[i];
    lengths[i] = ((dx[i] < 0.0 ? low : high) - x[i]) / dx[i];
  }
  for (int i = n; i < end; ++i)
    lengths[i] = -w[i] / dw[i];

  Step step{-w_[row] / dw_[row], End::solved, row};
  const auto limit = [&step](double length, End end, int by) {
    if (length < step.length)
      step = {length, end, by};
  };
  if (direction > 0.0) {
    if (hi_[row] < infinity)
      limit((hi_[row] - x_[row]) * direction, End::at_upper, row);
  } else if (lo_[row] > -infinity)
    limit((lo_[row] - x_[row]) * direction, End::at_lower, row);
  for (int i = n; i < end; ++i)
    if ((lengths[i] < step.length) & (side[i] * dw[i] > 0.0))
      step = {lengths[i], End::clamp, i};
  for (int i = num_free_; i < n; ++i)
    if ((lengths[i] < step.length) & (dx[i] != 0.0))
      step = {lengths[i], dx[i] < 0.0 ? End::release_at_lower : End::release_at_upper, i};
  return step;
}

/// To the clamped rows.
void DantzigLcp::clamp(int row, const Column& column)
{
  factor(row, column);
  swap_rows(num_clamped_, row);
  clamped_[num_clamped_] = num_clamped_;
  ++num_clamped_;
}

/// From the clamped rows to those at a bound. How many rows of the factors stay as they are.
int DantzigLcp::release(int row)
{
  const auto end = clamped_.begin() + num_clamped_;
  const auto place = std::find(clamped_.begin(), end, row);
  const auto index = static_cast<int>(place - clamped_.begin());
  remove_factor(index);
  *std::find(clamped_.begin(), end, num_clamped_ - 1) = row;
  std::move(place + 1, end, place);
  --num_clamped_;
  ++num_bound_;
  swap_rows(row, num_clamped_);
  return index;
}

/// dw of the rows at a bound and of the driven one.
void DantzigLcp::find_response(int row, double direction)
{
  const int n = num_clamped_, end = n + num_bound_;
  const double* x = dx_.data();
  int i = n;
  for (; i + 4 <= end; i += 4) {
    const double *a0 = A_[i], *a1 = A_[i + 1], *a2 = A_[i + 2], *a3 = A_[i + 3];
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    for (int j = 0; j < n; ++j) {
      s0 += a0[j] * x[j];
      s1 += a1[j] * x[j];
      s2 += a2[j] * x[j];
      s3 += a3[j] * x[j];
    }
    dw_[i] = s0;
    dw_[i + 1] = s1;
    dw_[i + 2] = s2;
    dw_[i + 3] = s3;
  }
  for (; i < end; ++i)
    dw_[i] = dot(A_[i], x, n);
  for (i = n; i < end; ++i)
    dw_[i] += direction * A_[row][i];
  dw_[row] = dot(A_[row], x, n) + A_[row][row] * direction;
}

void DantzigLcp::swap_rows(int row1, int row2)
{
  if (row1 == row2)
    return;
  double *a1 = A_[row1], *a2 = A_[row2];
  for (int i = row1 + 1; i < row2; ++i) {
    a1[i] = A_[i][row1];
    A_[i][row1] = a2[i];
  }
  a1[row2] = a1[row1];
  a1[row1] = a2[row1];
  a2[row1] = a2[row2];
  std::swap(A_[row1], A_[row2]);
  for (int i = row2 + 1; i < size_; ++i)
    std::swap(A_[i][row1], A_[i][row2]);
  for (double* numbers : {x_, b_, lo_, hi_, w_.data(), side_.data()})
    std::swap(numbers[row1], numbers[row2]);
  for (int* numbers : {findex_, original_.data()})
    std::swap(numbers[row1], numbers[row2]);
}

} // namespace pydart2
