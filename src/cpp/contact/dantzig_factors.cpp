#include <algorithm>
#include <cmath>

#include "contact/dantzig_lcp.hpp"

// The factors L D L' of the clamped rows: solving with them, a row more, a row less.

namespace pydart2 {

namespace {

/// sums[i] += columns[0][i] * factors[0] + columns[1][i] * factors[1] + ..., from left to right.
void add_columns(const double* columns, std::ptrdiff_t stride, const double* factors, int count, double* __restrict sums, int size)
{
  int k = 0;
  for (; k + 4 <= count; k += 4, columns += 4 * stride) {
    const double* __restrict c0 = columns;
    const double* __restrict c1 = c0 + stride;
    const double* __restrict c2 = c1 + stride;
    const double* __restrict c3 = c2 + stride;
    const double f0 = factors[k], f1 = factors[k + 1], f2 = factors[k + 2], f3 = factors[k + 3];
    for (int i = 0; i < size; ++i)
      sums[i] = (((sums[i] + c0[i] * f0) + c1[i] * f1) + c2[i] * f2) + c3[i] * f3;
  }
  for (; k < count; ++k, columns += stride)
    for (int i = 0; i < size; ++i)
      sums[i] += columns[i] * factors[k];
}

} // namespace

/// The column of a row, of which so many elements are known already. In blocks of four, in which what is above the block
/// is summed up first; only whole blocks can be known.
void DantzigLcp::find_column(int row, int known, Column& column)
{
  const int n = num_clamped_, begin = known / 4 * 4, blocks_end = n / 4 * 4;
  const double* a = A_[row];
  double* x = column.values.data();
  double* sums = sums_.data();
  for (int i = begin; i < n; ++i) {
    x[i] = a[clamped_[i]];
    sums[i] = 0.0;
  }
  add_columns(&L(begin, 0), stride_, x, begin, sums + begin, n - begin);
  int i = begin;
  for (; i < blocks_end; i += 4) {
    x[i] = x[i] - sums[i];
    x[i + 1] = x[i + 1] - sums[i + 1] - L(i + 1, i) * x[i];
    x[i + 2] = x[i + 2] - sums[i + 2] - L(i + 2, i) * x[i] - L(i + 2, i + 1) * x[i + 1];
    x[i + 3] = x[i + 3] - sums[i + 3] - L(i + 3, i) * x[i] - L(i + 3, i + 1) * x[i + 1] - L(i + 3, i + 2) * x[i + 2];
    add_columns(&L(i + 4, i), stride_, x + i, 4, sums + i + 4, n - i - 4);
  }
  for (; i < n; ++i) {
    x[i] = x[i] - sums[i];
    add_columns(&L(i + 1, i), stride_, x + i, 1, sums + i + 1, n - i - 1);
  }
  for (i = 0; i < n; ++i)
    column.scaled[i] = x[i] * inverse_D_[i];
}

/// dx of the clamped rows, L'^-1 D^-1 L^-1 a with a sign: how they answer to the driven one. From the last row up, in
/// blocks of four.
void DantzigLcp::find_direction(double sign)
{
  const int n = num_clamped_;
  double* x = first_.data();
  std::copy(driven_.scaled.begin(), driven_.scaled.begin() + n, x);
  int i = n - 1;
  for (; i >= 3; i -= 4) {
    const double *c0 = &L(0, i), *c1 = c0 - stride_, *c2 = c1 - stride_, *c3 = c2 - stride_;
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    for (int j = n - 1; j > i; --j) {
      s0 += c0[j] * x[j];
      s1 += c1[j] * x[j];
      s2 += c2[j] * x[j];
      s3 += c3[j] * x[j];
    }
    x[i] = x[i] - s0;
    x[i - 1] = x[i - 1] - s1 - c1[i] * x[i];
    x[i - 2] = x[i - 2] - s2 - c2[i] * x[i] - c2[i - 1] * x[i - 1];
    x[i - 3] = x[i - 3] - s3 - c3[i] * x[i] - c3[i - 1] * x[i - 1] - c3[i - 2] * x[i - 2];
  }
  for (; i >= 0; --i) {
    const double* c0 = &L(0, i);
    double s0 = 0.0;
    for (int j = n - 1; j > i; --j)
      s0 += c0[j] * x[j];
    x[i] = x[i] - s0;
  }
  for (i = 0; i < n; ++i)
    dx_[clamped_[i]] = sign * x[i];
}

/// A row more of the factors.
void DantzigLcp::factor(int row, const Column& column)
{
  const int n = num_clamped_;
  for (int i = 0; i < n; ++i)
    L(n, i) = column.scaled[i];
  const double diagonal = A_[row][row];
  inverse_D_[n] = 1.0 / (n > 0 ? diagonal - dot(column.scaled.data(), column.values.data(), n) : diagonal);
}

/// A row less of the factors. Setting its row and column of the matrix to those of the identity is a symmetric change of
/// rank two, which update_factors() takes in; then they can go.
void DantzigLcp::remove_factor(int index)
{
  const int n = num_clamped_, size = n - index;
  if (size == 1)
    return;
  double* change = sums_.data();
  std::fill(change, change + size, 0.0);
  for (int i = 0; i < index; ++i)
    second_[i] = L(index, i) / inverse_D_[i];
  add_columns(&L(index, 0), stride_, second_.data(), index, change, size);
  const int row = clamped_[index];
  for (int i = 0; i < size; ++i)
    change[i] = change[i] - A(clamped_[index + i], row);
  change[0] += 1.0;
  // On the diagonal of `change` half of it counts for its row and half for its column.
  update_factors(index);
  for (int column = 0; column < index; ++column)
    std::copy(&L(index + 1, column), &L(n, column), &L(index, column));
  for (int column = index; column < n - 1; ++column)
    std::copy(&L(column + 2, column + 1), &L(n, column + 1), &L(column + 1, column));
  std::copy(inverse_D_.begin() + index + 1, inverse_D_.begin() + n, inverse_D_.begin() + index);
}

/// Factors, from row `first` on, after adding the change in sums_ to the row and to the column `first`: as the sum of a
/// dyad u u' and of -v v', each by the method of Bennett (Numerische Mathematik 7, 1965). What becomes of row and column
/// `first` themselves is not computed.
void DantzigLcp::update_factors(int first)
{
  const int size = num_clamped_ - first;
  double* __restrict u = first_.data();
  double* __restrict v = second_.data();
  for (int i = 1; i < size; ++i)
    u[i] = v[i] = sums_[i] * M_SQRT1_2;
  const double u0 = (0.5 * sums_[0] + 1.0) * M_SQRT1_2, v0 = (0.5 * sums_[0] - 1.0) * M_SQRT1_2;
  double alpha1 = 1.0, alpha2 = 1.0;
  for (int column = 0; column < size; ++column) {
    const double p = column == 0 ? u0 : u[column], q = column == 0 ? v0 : v[column];
    double* d = &inverse_D_[first + column];
    double inverse = *d;
    double alpha = alpha1 + (p * p) * inverse;
    inverse /= alpha;
    const double gamma1 = p * inverse;
    inverse *= alpha1;
    alpha1 = alpha;
    alpha = alpha2 - (q * q) * inverse;
    inverse /= alpha;
    const double gamma2 = q * inverse;
    inverse *= alpha2;
    alpha2 = alpha;
    double* __restrict l = &L(first, first + column);
    if (column == 0) {
      const double k1 = 1.0 - q * gamma1, k2 = q * gamma1 * p - q;
      for (int i = 1; i < size; ++i) {
        const double old = u[i];
        u[i] = old - p * l[i];
        v[i] = k1 * old + k2 * l[i];
      }
      continue;
    }
    *d = inverse;
    for (int i = column + 1; i < size; ++i) {
      const double a = u[i] - p * l[i];
      const double half = l[i] + gamma1 * a;
      const double b = v[i] - q * half;
      u[i] = a;
      v[i] = b;
      l[i] = half - gamma2 * b;
    }
  }
}

} // namespace pydart2
