#include "contact/fast_solver.hpp"

/// What the exact solver does where there are contacts of rigid bodies only: most of the time.
namespace pydart2 {

/// As solve_exactly() the groups of the engine's constraints.
void FastConstraintSolver::solve_contacts()
{
  contacts_.read(mCollisionResult);
  const auto& groups = contacts_.groups();
  for (std::size_t i = 0; i < groups.size(); ++i) {
    matrix_.clear();
    rows_.clear();
    for (const int contact : groups[i]) {
      const auto begin = rows_.size();
      const int dimension = contacts_.dimension(contact);
      rows_.resize(begin + static_cast<std::size_t>(dimension));
      contacts_.read_rows(contact, matrix_.add_rows(dimension), mTimeStep, rows_.data() + begin);
    }
    largest_group_ = std::max(largest_group_, static_cast<int>(rows_.size()));
    check_memory(rows_.size());
    matrix_.settle();
    const auto size = static_cast<Eigen::Index>(rows_.size());
    mX.setZero(size);
    mB.resize(size);
    mLo.resize(size);
    mHi.resize(size);
    mFIndex.resize(size);
    int first = 0;
    for (Eigen::Index row = 0; row < size; ++row) {
      const auto& from = rows_[static_cast<std::size_t>(row)];
      first = from.friction ? first : static_cast<int>(row);
      mB[row] = from.b;
      mLo[row] = from.lo;
      mHi[row] = from.hi;
      mFIndex[row] = from.friction ? first : -1;
    }
    solve_rows(nullptr, i);
    const double* impulses = mX.data();
    for (std::size_t k = 0; k < groups[i].size(); ++k) {
      contacts_.store_force(groups[i][k], impulses, mTimeStep);
      matrix_.apply(k, impulses);
      impulses += contacts_.dimension(groups[i][k]);
    }
  }
}

} // namespace pydart2
