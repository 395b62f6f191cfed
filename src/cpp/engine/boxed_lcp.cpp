#include "engine/boxed_lcp.hpp"

#include <cmath>
#include <dart/constraint/ConstraintBase.hpp>
#include <dart/external/odelcpsolver/common.h>
#include <string>

#include "base/errors.hpp"
#include "engine/import_table.hpp"

namespace pydart2 {

namespace {

/// Rows and columns begin .. end, as the engine counts them.
bool symmetric(const void*, std::size_t n, const double* A, std::size_t begin, std::size_t end)
{
  const std::size_t stride = dPAD(n);
  for (std::size_t i = begin; i <= end; ++i)
    for (std::size_t j = begin; j < i; ++j)
      if (std::abs(A[stride * i + j] - A[stride * j + i]) > 1e-6)
        throw Error(
            Kind::engine,
            "the matrix of the contacts and constraints is not symmetric (" + std::to_string(A[stride * i + j]) + " and "
                + std::to_string(A[stride * j + i])
                + "), masses or levers of very different sizes make it so (world.set_constraint_solver(\"fast\") does not ask)");
  return true;
}

bool all_symmetric(const void* self, std::size_t n, const double* A)
{
  return symmetric(self, n, A, 0, n - 1);
}

} // namespace

void make_asymmetry_throw()
{
  const auto name = std::string("_ZN4dart10constraint24BoxedLcpConstraintSolver11isSymmetricEmPd");
  redirect({"libdart"}, name.c_str(), reinterpret_cast<void*>(&all_symmetric));
  redirect({"libdart"}, (name + "mm").c_str(), reinterpret_cast<void*>(&symmetric));
}

void remove_empty_constraints(dart::constraint::ConstrainedGroup& group)
{
  for (std::size_t i = group.getNumConstraints(); i-- > 0;)
    if (const auto constraint = group.getConstraint(i); constraint->getDimension() == 0)
      group.removeConstraint(constraint);
}

} // namespace pydart2
