#pragma once

#include <Eigen/Core>

namespace pydart2 {

/// Numbers from the caller, any length: contiguous, not owned.
struct VectorIn
{
  const double* data = nullptr;
  long size = 0;

  Eigen::Map<const Eigen::VectorXd> eigen() const { return {data, size}; }
};

/// Rows of numbers from the caller, row-major, contiguous, not owned.
struct MatrixIn
{
  const double* data = nullptr;
  long rows = 0, cols = 0;
};

/// Memory of the caller to be filled, row-major, contiguous, not owned: for calls without the interpreter lock.
struct MatrixOut
{
  double* data = nullptr;
  long rows = 0, cols = 0;
};

/// Where a method puts its result. The method asks once for memory of the shape that it is about to fill, so that
/// the engine's numbers are copied once, straight into what the caller gets (a fresh ndarray, swig/typemaps.i).
class Output
{
public:
  virtual ~Output() = default;
  virtual double* vector(long size) = 0;

  /// Row-major.
  virtual double* matrix(long rows, long cols) = 0;
};

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Eigen's view of the memory that an Output gives.
inline Eigen::Map<Eigen::VectorXd> vector(Output& out, long size)
{
  return {out.vector(size), size};
}

inline Eigen::Map<RowMajor> matrix(Output& out, long rows, long cols)
{
  return {out.matrix(rows, cols), rows, cols};
}

} // namespace pydart2
