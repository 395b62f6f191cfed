#pragma once

#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/DynamicJointConstraint.hpp>
#include <dart/simulation/World.hpp>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "contact/constraint_matrix.hpp"
#include "contact/dantzig_lcp.hpp"
#include "contact/direct_contacts.hpp"
#include "contact/exact_residual.hpp"
#include "contact/iterative_solver.hpp"
#include "contact/jointed.hpp"
#include "contact/warm_lcp.hpp"

namespace pydart2 {

/// Which code solves the constraints of a world; the results of the first two are bitwise the same.
enum class Solver { dart, fast, iterative };

/// "dart", "fast" or "iterative"; ValueError for any other name.
Solver solver_named(const std::string& name);
const char* name_of(Solver solver);

/// What a new world gets: "fast", or what the environment variable PYDART2_SOLVER names.
Solver default_solver();

/// DART's constraint solver with a faster way to the constraint matrix (ConstraintMatrix). All else is DART's own:
/// collision detection, the making and grouping of constraints, the right-hand sides and bounds, the LCP solvers.
class FastConstraintSolver final : public dart::constraint::BoxedLcpConstraintSolver
{
public:
  /// `dart` turns all over to the base class.
  void set_solver(Solver solver) { solver_ = solver; }
  Solver solver() const { return solver_; }

  /// Leaves out contacts that the others of a face pair make up for (contact_reduction.hpp).
  void set_contact_reduction(bool enable) { contact_reduction_ = enable; }
  bool contact_reduction() const { return contact_reduction_; }

  /// Begins each step's LCP from the one before (warm_lcp.hpp); forgets what it remembers.
  void set_warm_start(bool enable);
  bool warm_start() const { return warm_start_; }

  IterativeSolver& iterative() { return iterative_; }

  /// What a step is about, where that is not all the skeletons of the world through the engine's objects.
  struct Step
  {
    std::vector<dart::dynamics::SkeletonPtr>& skeletons; ///< That are awake, without those in `free`; no impulse acts on them.
    Jointed& jointed; ///< Of them.
    bool rigid; ///< No skeleton has a soft body.
    FreeBodies* free;
    bool same; ///< No skeleton has changed since the step before but for its state.
    /// Asked with the contacts for the sleepers that wake, after which the contacts are found anew; null if none sleeps.
    std::function<std::vector<dart::dynamics::SkeletonPtr>(const dart::collision::CollisionResult&)> wake;
  };

  /// solve() by the chosen solver.
  void solve_step(const Step& step);

  /// Whether all contacts and constraints are solved by sweeps.
  bool sweeps_all() const { return solver_ == Solver::iterative && all_known(); }

  /// What the chosen solver remembers of the step before, and back; false, and nothing changes, if these are other
  /// numbers.
  std::vector<double> memory() const;
  bool remember(const std::vector<double>& memory);
  void forget();

  /// Most bytes that the matrices of one group may take; a step that needs more throws before it allocates them.
  void set_memory_limit(double bytes) { memory_limit_ = bytes; }
  double memory_limit() const { return memory_limit_; }

  /// How much of the error of ball and weld joint constraints a step takes away, 0 to 1.
  void set_error_reduction(double share) { error_reduction_ = share; }
  double error_reduction() const { return error_reduction_; }
  static double engine_error_reduction() { return dart::constraint::DynamicJointConstraint::getErrorReductionParameter(); }

  /// Of the last step, over all groups (contact/exact_residual.hpp, iterative_solver.hpp), m/s or rad/s. That the exact
  /// solvers' friction bounds are those of the normal forces without friction shows in it.
  double residual() const { return std::max(exact_residual_, iterative_.residual()); }

  /// Rows of the largest group that was solved exactly, since the last call.
  int take_largest_group() { return std::exchange(largest_group_, 0); }

  /// Takes over what `other` has, its collision group included: a new one would change the order of the contacts.
  void setFromOtherConstraintSolver(const dart::constraint::ConstraintSolver& other) override;

protected:
  void solveConstrainedGroup(dart::constraint::ConstrainedGroup& group) override;

private:
  bool nothing_collides() const;
  void solve_by_groups(const Step& step);
  void clear_constraints();
  void solve_contacts(const Step& step);
  void solve_group(std::size_t number);
  void solve_active();
  void find_constraints(const Step& step);
  bool wake(const Step& step);
  void solve_by_sweeps(const Step& step);
  const std::vector<native::Touch>* find_contacts(const Step& step);
  void drop_gaps();
  void gather(const Step& step);
  void gather_from_groups(const Step& step);
  bool all_known() const;
  void scale_error(dart::constraint::ConstraintBase& constraint) const;
  void solve_exactly(dart::constraint::ConstrainedGroup& group);
  void take_residual(const Eigen::VectorXd& x) { exact_residual_ = std::max(exact_residual_, problem_.of(x)); }
  bool groups_share_skeletons();
  void check_memory(std::size_t rows) const;
  void begin_group(std::size_t rows);
  dart::constraint::ConstraintInfo terms_at(int row);
  void count_from(int begin, int end);
  void solve_rows(dart::constraint::ConstrainedGroup* group, std::size_t number);
  void solve_lcp(std::size_t group);
  void solve_lcp_again();

  Solver solver_ = Solver::fast;
  bool contact_reduction_ = false;
  bool warm_start_ = false;
  double memory_limit_ = 1e9;
  int largest_group_ = 0;
  double error_reduction_ = engine_error_reduction();
  bool shared_ = false; ///< Of the present step: some skeleton is in two groups.
  ConstraintMatrix matrix_;
  DirectContacts contacts_;
  DantzigLcp dantzig_lcp_;
  IterativeSolver iterative_;
  WarmLcp warm_lcp_;
  ExactResidual problem_; ///< Of the group that is being solved.
  double exact_residual_ = 0.0;
  Eigen::VectorXd warm_x_;
};

/// What stands for no limit: detectors take the number for an int.
constexpr std::size_t unlimited_contacts = std::numeric_limits<int>::max();

/// Gives a world such a solver. Its collision detector, contacts, constraints and LCP solvers stay as they are, and so
/// does the order of its contacts.
void install_solver(dart::simulation::World& world, Solver solver);

/// The solver that install_solver() gave.
FastConstraintSolver& fast_solver(const dart::simulation::World& world);

} // namespace pydart2
