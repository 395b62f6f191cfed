#pragma once

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/Skeleton.hpp>

namespace pydart2 {

/// What `read` gives for each dof of a skeleton.
template <class Read>
Eigen::VectorXd each_dof(const dart::dynamics::Skeleton& skeleton, Read read)
{
  Eigen::VectorXd values(static_cast<long>(skeleton.getNumDofs()));
  for (std::size_t i = 0; i < skeleton.getNumDofs(); ++i)
    values[static_cast<long>(i)] = read(*skeleton.getDof(i));
  return values;
}

} // namespace pydart2
