#include "contact/fast_solver.hpp"

/// What the exact solver does where there are contacts of rigid bodies and joints only: most of the time.
namespace pydart2 {

void FastConstraintSolver::solve_contacts(const Step& step)
{
  contacts_.read(mCollisionResult);
  for (const auto& constraint : step.jointed.make_constraints()) {
    constraint->update();
    if (constraint->isActive())
      mActiveConstraints.push_back(constraint);
  }
  if (contacts_.group_with(mActiveConstraints)) {
    for (std::size_t i = 0; i < contacts_.groups().size(); ++i)
      solve_group(i);
    return;
  }
  DirectContacts::Constraints contacts;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    contacts.push_back(contacts_.make_constraint(i, mTimeStep));
  mActiveConstraints.insert(mActiveConstraints.begin(), contacts.begin(), contacts.end());
  solve_active();
}

/// As solve_exactly() the groups of the engine's constraints.
void FastConstraintSolver::solve_group(std::size_t number)
{
  const auto& members = contacts_.groups()[number];
  const auto count = contacts_.size();
  const auto dimension = [&](std::size_t member) {
    return member < count ? contacts_.dimension(member) : mActiveConstraints[member - count]->getDimension();
  };
  std::size_t rows = 0;
  for (const auto member : members)
    rows += dimension(member);
  if (rows == 0)
    return;
  begin_group(rows);
  matrix_.clear();
  int row = 0;
  for (const auto member : members) {
    const int end = row + static_cast<int>(dimension(member));
    auto& at = matrix_.add_rows(end - row);
    auto terms = terms_at(row);
    if (member < count) {
      contacts_.read_rows(member, at, mTimeStep, terms);
    } else {
      auto& constraint = *mActiveConstraints[member - count];
      engine::read_rows(constraint, at);
      constraint.getInformation(&terms);
    }
    count_from(row, end);
    row = end;
  }
  matrix_.settle();
  solve_rows(nullptr, number);
  double* impulses = mX.data();
  for (std::size_t i = 0; i < members.size(); impulses += dimension(members[i]), ++i)
    if (members[i] < count) {
      contacts_.store_force(members[i], impulses, mTimeStep);
      matrix_.apply(i, impulses);
    } else {
      auto& constraint = *mActiveConstraints[members[i] - count];
      constraint.applyImpulse(impulses);
      constraint.excite();
    }
}

} // namespace pydart2
