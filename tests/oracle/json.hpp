// JSON as the oracle writes it: every value becomes its text.
//
// Numbers carry 17 significant digits, so doubles read back bit for bit; infinities and NaN are written as Python's
// json module reads them: Infinity, -Infinity, NaN. An array is {"dtype", "shape", "values"}, values by rows.

#pragma once

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

inline std::string number(double x)
{
  if (std::isnan(x))
    return "NaN";
  if (std::isinf(x))
    return x > 0 ? "Infinity" : "-Infinity";
  std::ostringstream out;
  out << std::setprecision(17) << x;
  return out.str();
}

inline std::string text(const std::string& s)
{
  std::ostringstream out;
  out << std::quoted(s);  // enough for names: no control characters
  return out.str();
}

inline std::string list(const std::vector<std::string>& items)
{
  std::string out = "[";
  for (const std::string& item : items)
    out += (out.size() > 1 ? ", " : "") + item;
  return out + "]";
}

inline std::string object(const std::vector<std::pair<std::string, std::string>>& members)
{
  std::string out = "{";
  for (const auto& [name, value] : members)
    out += (out.size() > 1 ? ", " : "") + text(name) + ": " + value;
  return out + "}";
}

// A column vector type gives shape [n], any other matrix [rows, columns].
template <typename Derived>
std::string array(const Eigen::MatrixBase<Derived>& m)
{
  std::vector<std::string> shape{std::to_string(m.rows())}, values;
  if (Derived::ColsAtCompileTime != 1)
    shape.push_back(std::to_string(m.cols()));
  for (Eigen::Index row = 0; row < m.rows(); ++row)
    for (Eigen::Index column = 0; column < m.cols(); ++column)
      values.push_back(number(static_cast<double>(m(row, column))));
  const bool whole = std::is_integral<typename Derived::Scalar>::value;
  return object({{"dtype", text(whole ? "int64" : "float64")}, {"shape", list(shape)}, {"values", list(values)}});
}
