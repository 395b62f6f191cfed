#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>

#include "base/arrays.hpp"

/// What DART would answer with an abort or with nonsense is refused here, with what was asked, expected and got.
namespace pydart2::check {

/// Numbers beyond this count as infinite: the engine's products of them would be.
constexpr double huge = 1e30;

/// `index` in 0 .. count-1, as a size; IndexError otherwise.
std::size_t index(long index, std::size_t count, const char* what);

/// The length of a vector; ValueError otherwise.
void size(long got, std::size_t expected, const char* what);

/// The shape of a matrix; ValueError otherwise.
void shape(const MatrixIn& got, std::size_t rows, std::size_t cols, const char* what);

/// No NaN and nothing beyond `huge`; ValueError otherwise.
void finite(double value, const char* what);
void finite(const VectorIn& values, const char* what);
void finite(const Eigen::Vector3d& values, const char* what);

/// The bounds of a range: any number, and infinite where there is none on that side. Which is the larger is not asked:
/// one is often set before the other.
void lower_limit(double value, const char* what);
void upper_limit(double value, const char* what);

/// Finite and > 0, or >= 0; ValueError otherwise.
void positive(double value, const char* what);
void not_negative(double value, const char* what);

/// A rigid transform: finite, rotation orthonormal to 1e-6 and right-handed, last row 0 0 0 1.
void rigid(const Eigen::Matrix4d& matrix, const char* what);

/// A direction: finite and not zero.
void direction(const Eigen::Vector3d& vector, const char* what);

/// A 3x3 moment of inertia: finite, symmetric, positive definite.
void inertia(const Eigen::Matrix3d& matrix, const char* what);

} // namespace pydart2::check
