#include "base/checks.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <sstream>

#include "base/errors.hpp"

namespace pydart2::check {

namespace {

[[noreturn]] void refuse(Kind kind, const char* what, const std::string& problem)
{
  throw Error(kind, std::string(what) + " " + problem);
}

bool is_finite(double value)
{
  return std::abs(value) <= huge; // false for NaN
}

std::string text(double value)
{
  std::ostringstream out;
  out << value;
  if (std::isfinite(value) && !is_finite(value))
    out << " (beyond " << huge << " counts as infinite)";
  return out.str();
}

} // namespace

std::size_t index(long index, std::size_t count, const char* what)
{
  if (index < 0 || static_cast<std::size_t>(index) >= count)
    refuse(Kind::index, what, "index " + std::to_string(index) + " is out of range: there are " + std::to_string(count));
  return static_cast<std::size_t>(index);
}

void size(long got, std::size_t expected, const char* what)
{
  if (got < 0 || static_cast<std::size_t>(got) != expected)
    refuse(Kind::value, what, "needs " + std::to_string(expected) + " numbers, got " + std::to_string(got));
}

void shape(const MatrixIn& got, std::size_t rows, std::size_t cols, const char* what)
{
  if (static_cast<std::size_t>(got.rows) == rows && static_cast<std::size_t>(got.cols) == cols)
    return;
  const auto text = [](auto r, auto c) { return "(" + std::to_string(r) + ", " + std::to_string(c) + ")"; };
  refuse(Kind::value, what, "needs shape " + text(rows, cols) + ", got " + text(got.rows, got.cols));
}

void finite(double value, const char* what)
{
  if (!is_finite(value))
    refuse(Kind::value, what, "must be finite, got " + text(value));
}

void finite(const VectorIn& values, const char* what)
{
  for (long i = 0; i < values.size; ++i)
    if (!is_finite(values.data[i]))
      refuse(Kind::value, what, "must be finite, got " + text(values.data[i]) + " at index " + std::to_string(i));
}

void finite(const Eigen::Vector3d& values, const char* what)
{
  finite(VectorIn{values.data(), 3}, what);
}

void lower_limit(double value, const char* what)
{
  if (!(value <= huge))
    refuse(Kind::value, what, "must be a number or -inf, got " + text(value));
}

void upper_limit(double value, const char* what)
{
  if (!(value >= -huge))
    refuse(Kind::value, what, "must be a number or inf, got " + text(value));
}

void positive(double value, const char* what)
{
  if (!is_finite(value) || value <= 0.0)
    refuse(Kind::value, what, "must be positive and finite, got " + text(value));
}

void not_negative(double value, const char* what)
{
  if (!is_finite(value) || value < 0.0)
    refuse(Kind::value, what, "must be zero or positive, and finite, got " + text(value));
}

void rigid(const Eigen::Matrix4d& matrix, const char* what)
{
  if (!(matrix.cwiseAbs().maxCoeff() <= huge) || matrix.hasNaN())
    refuse(Kind::value, what, "must be finite");
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  const bool orthonormal = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6;
  const bool last_row = (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() < 1e-9;
  if (!orthonormal || !last_row || R.determinant() < 0.0)
    refuse(Kind::value, what, "must be a rigid 4x4 transform: a rotation, a translation and the last row 0 0 0 1");
}

void direction(const Eigen::Vector3d& vector, const char* what)
{
  finite(vector, what);
  if (vector.norm() < 1e-12)
    refuse(Kind::value, what, "must not be the zero vector");
}

void inertia(const Eigen::Matrix3d& matrix, const char* what)
{
  if (!(matrix.cwiseAbs().maxCoeff() <= huge) || matrix.hasNaN())
    refuse(Kind::value, what, "must be finite");
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > 1e-9 * matrix.cwiseAbs().maxCoeff())
    refuse(Kind::value, what, "must be symmetric");
  if (Eigen::LLT<Eigen::Matrix3d>(matrix).info() != Eigen::Success)
    refuse(Kind::value, what, "must be positive definite");
}

} // namespace pydart2::check
