#include "engine/fixed_skins.hpp"

#include <algorithm>
#include <dart/constraint/SoftContactConstraint.hpp>
#include <dart/dynamics/BodyNode.hpp>

namespace pydart2 {

namespace {

using dart::constraint::ConstraintSolver;
using dart::constraint::SoftContactConstraint;

struct SolverConstraints : ConstraintSolver
{
  static auto& soft_of(ConstraintSolver& solver) { return solver.*(&SolverConstraints::mSoftContactConstraints); }
  static auto& active_of(ConstraintSolver& solver) { return solver.*(&SolverConstraints::mActiveConstraints); }
};

bool moves_something(const SoftContactConstraint& constraint);

// An explicit instantiation may name private members, as in engine_access.cpp.
template <auto one, auto other>
struct Reveal
{
  friend bool moves_something(const SoftContactConstraint& constraint)
  {
    return (constraint.*one)->isReactive() || (constraint.*other)->isReactive();
  }
};
template struct Reveal<&SoftContactConstraint::mBodyNode1, &SoftContactConstraint::mBodyNode2>;

} // namespace

void drop_fixed_skins(ConstraintSolver& solver)
{
  if (SolverConstraints::soft_of(solver).empty())
    return;
  auto& active = SolverConstraints::active_of(solver);
  const auto stands = [](const auto& constraint) {
    const auto* soft = dynamic_cast<const SoftContactConstraint*>(constraint.get());
    return soft != nullptr && !moves_something(*soft);
  };
  active.erase(std::remove_if(active.begin(), active.end(), stands), active.end());
}

} // namespace pydart2
