#include "contact/fast_solver.hpp"

#include <cstdlib>
#include <dart/common/Console.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/external/odelcpsolver/common.h>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>

#include "base/errors.hpp"
#include "contact/contact_reduction.hpp"
#include "engine/collision_filter.hpp"
#include "engine/fixed_skins.hpp"
#include "engine/boxed_lcp.hpp"

namespace pydart2 {

using dart::constraint::ConstrainedGroup;

Solver solver_named(const std::string& name)
{
  if (name == "dart")
    return Solver::dart;
  if (name == "fast")
    return Solver::fast;
  if (name == "iterative")
    return Solver::iterative;
  throw Error(Kind::value, "no constraint solver '" + name + "'; there are fast, dart and iterative");
}

const char* name_of(Solver solver)
{
  return solver == Solver::fast ? "fast" : solver == Solver::dart ? "dart" : "iterative";
}

Solver default_solver()
{
  const char* name = std::getenv("PYDART2_SOLVER");
  if (name == nullptr || *name == '\0')
    return Solver::fast;
  try {
    return solver_named(name);
  } catch (const Error& error) {
    throw Error(Kind::value, std::string("environment variable PYDART2_SOLVER: ") + error.what());
  }
}

void install_solver(dart::simulation::World& world, Solver solver)
{
  auto installed = std::make_unique<FastConstraintSolver>();
  installed->set_solver(solver);
  installed->set_warm_start(solver == Solver::iterative);
  installed->set_contact_reduction(solver == Solver::iterative);
  world.setConstraintSolver(std::move(installed));
  // The engine stops at 1,000 without a word: what is in the others' place sinks.
  world.getConstraintSolver()->getCollisionOption().maxNumContacts = unlimited_contacts;
}

FastConstraintSolver& fast_solver(const dart::simulation::World& world)
{
  return static_cast<FastConstraintSolver&>(*const_cast<dart::simulation::World&>(world).getConstraintSolver());
}

void FastConstraintSolver::set_warm_start(bool enable)
{
  warm_start_ = enable;
  forget();
}

namespace {

/// Two values change places, for the time of a step.
template <class Value>
struct Exchange
{
  Exchange(Value& a, Value& b) : a(a), b(b) { std::swap(a, b); }
  ~Exchange() { std::swap(a, b); }
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  Value &a, &b;
};

} // namespace

/// Whether the filter lets no pair pass: there is one skeleton, whose bodies do not collide with each other. In the trees of
/// Bullet and ODE the order of later pairs would show that they were not asked.
bool FastConstraintSolver::nothing_collides() const
{
  if (mSkeletons.size() != 1)
    return false;
  const std::string& detector = mCollisionDetector->getType();
  return detector != "bullet" && detector != "ode"
         && engine::PairFilter(mCollisionOption.collisionFilter.get()).surely_ignores_within(*mSkeletons.front());
}

void FastConstraintSolver::solve_step(const Step& step)
{
  exact_residual_ = 0.0;
  std::size_t most = nothing_collides() ? 0 : mCollisionOption.maxNumContacts;
  const Exchange option(mCollisionOption.maxNumContacts, most);
  if (solver_ == Solver::iterative)
    iterative_.begin_step(mSkeletons, step.same, step.free);
  const Exchange skeletons(mSkeletons, step.skeletons);
  if (solver_ == Solver::iterative)
    solve_by_sweeps(step);
  else
    solve_by_groups(step);
}

/// The engine's solve(), with what wakes, and without flags of colliding bodies that nobody reads.
void FastConstraintSolver::solve_by_groups(const Step& step)
{
  if (step.rigid && mManualConstraints.empty() && solver_ == Solver::fast && !contact_reduction_) {
    clear_constraints();
    mCollisionResult.clear();
    mCollisionGroup->collide(mCollisionOption, &mCollisionResult);
    if (!wake(step))
      return solve_contacts(step);
    updateConstraints();
  } else {
    find_constraints(step);
  }
  drop_fixed_skins(*this);
  solve_active();
}

void FastConstraintSolver::solve_active()
{
  buildConstrainedGroups();
  solveConstrainedGroups();
}

void FastConstraintSolver::clear_constraints()
{
  mActiveConstraints.clear();
  mContactConstraints.clear();
  mSoftContactConstraints.clear();
  mJointConstraints.clear();
  mMimicMotorConstraints.clear();
  mJointCoulombFrictionConstraints.clear();
  mConstrainedGroups.clear();
}

void FastConstraintSolver::find_constraints(const Step& step)
{
  {
    const Exchange skeletons(mSkeletons, step.jointed.skeletons); // which the engine asks for constraints of their joints
    updateConstraints();
  }
  if (wake(step))
    updateConstraints();
}

bool FastConstraintSolver::wake(const Step& step)
{
  if (!step.wake)
    return false;
  const auto woken = step.wake(mCollisionResult);
  mSkeletons.insert(mSkeletons.end(), woken.begin(), woken.end());
  return !woken.empty();
}

namespace {

constexpr double exact_groups = -2.0; ///< Before what is remembered of groups that the iterative solver leaves to the other.

} // namespace

std::vector<double> FastConstraintSolver::memory() const
{
  auto exact = warm_lcp_.memory();
  if (solver_ != Solver::iterative)
    return exact;
  const auto swept = iterative_.memory.numbers();
  if (!exact.empty())
    exact.insert(exact.begin(), {exact_groups, static_cast<double>(exact.size())});
  exact.insert(exact.end(), swept.begin(), swept.end());
  return exact;
}

bool FastConstraintSolver::remember(const std::vector<double>& memory)
{
  if (solver_ != Solver::iterative)
    return warm_lcp_.remember(memory);
  std::vector<double> exact, swept = memory;
  if (memory.size() >= 2 && memory[0] == exact_groups) {
    const double count = memory[1];
    if (!(count >= 0.0 && count <= static_cast<double>(memory.size() - 2) && count == std::floor(count)))
      return false;
    const auto end = memory.begin() + 2 + static_cast<std::ptrdiff_t>(count);
    exact.assign(memory.begin() + 2, end);
    swept.assign(end, memory.end());
  }
  return swept.size() % ContactMemory::numbers_per_entry == 0 && warm_lcp_.remember(exact) && iterative_.memory.restore(swept);
}

void FastConstraintSolver::forget()
{
  warm_lcp_.forget();
  iterative_.memory.forget();
}

void FastConstraintSolver::setFromOtherConstraintSolver(const ConstraintSolver& from)
{
  auto& other = const_cast<ConstraintSolver&>(from); // its collision group is shared, not changed
  mCollisionDetector = other.getCollisionDetector();
  mCollisionGroup = other.getCollisionGroup();
  mCollisionOption = other.getCollisionOption();
  mCollisionResult = other.getLastCollisionResult();
  mSkeletons = other.getSkeletons();
  mManualConstraints = other.getConstraints();
  if (const auto* boxed = dynamic_cast<const BoxedLcpConstraintSolver*>(&from)) {
    mBoxedLcpSolver = std::const_pointer_cast<dart::constraint::BoxedLcpSolver>(boxed->getBoxedLcpSolver());
    mSecondaryBoxedLcpSolver
        = std::const_pointer_cast<dart::constraint::BoxedLcpSolver>(boxed->getSecondaryBoxedLcpSolver());
  }
}

void FastConstraintSolver::solveConstrainedGroup(ConstrainedGroup& group)
{
  if (&group == &mConstrainedGroups.front())
    shared_ = solver_ != Solver::dart && mConstrainedGroups.size() > 1 && groups_share_skeletons();
  if (contact_reduction_)
    keep_extremal_contacts(group);
  solve_exactly(group);
}

void FastConstraintSolver::scale_error(dart::constraint::ConstraintBase& constraint) const
{
  if (const double engine = engine_error_reduction(); error_reduction_ != engine)
    engine::scale_error(constraint, error_reduction_ / engine);
}

void FastConstraintSolver::solve_exactly(ConstrainedGroup& group)
{
  for (std::size_t i = 0; i < group.getNumConstraints(); ++i)
    scale_error(*group.getConstraint(i));
  begin_group(group.getTotalDimension());
  if (solver_ == Solver::dart || shared_) {
    remove_empty_constraints(group);
    BoxedLcpConstraintSolver::solveConstrainedGroup(group);
    if (group.getTotalDimension() > 0 && mSecondaryBoxedLcpSolver != nullptr) {
      problem_.keep(mABackup, mBBackup, mLoBackup, mHiBackup, mFIndexBackup);
      take_residual(mX);
    }
    return;
  }
  if (group.getTotalDimension() == 0)
    return;
  int row = 0;
  for (std::size_t i = 0; i < group.getNumConstraints(); ++i) {
    const auto constraint = group.getConstraint(i);
    const int end = row + static_cast<int>(constraint->getDimension());
    auto terms = terms_at(row);
    constraint->getInformation(&terms);
    count_from(row, end);
    row = end;
  }
  matrix_.read(group, mSkeletons);
  solve_rows(&group, static_cast<std::size_t>(&group - mConstrainedGroups.data()));
  matrix_.apply(group, mTimeStep, mX);
}

/// Of what was read, and is a group of the engine's or all contacts.
void FastConstraintSolver::solve_rows(ConstrainedGroup* group, std::size_t number)
{
  mA.resize(mX.size(), dPAD(mX.size()));
  matrix_.fill(group, mTimeStep, mA);
  problem_.keep(mA, mB, mLo, mHi, mFIndex);
  solve_lcp(number);
  take_residual(mX);
}

/// For all but A: bounds, right-hand sides, and for friction the row of the normal force.
void FastConstraintSolver::begin_group(std::size_t rows)
{
  largest_group_ = std::max(largest_group_, static_cast<int>(rows));
  check_memory(rows);
  const auto size = static_cast<Eigen::Index>(rows);
  mX.setZero(size);
  mB.resize(size);
  mW.setZero(size);
  mLo.resize(size);
  mHi.resize(size);
  mFIndex.setConstant(size, -1);
}

dart::constraint::ConstraintInfo FastConstraintSolver::terms_at(int row)
{
  dart::constraint::ConstraintInfo terms;
  terms.invTimeStep = 1.0 / mTimeStep;
  terms.x = mX.data() + row;
  terms.lo = mLo.data() + row;
  terms.hi = mHi.data() + row;
  terms.b = mB.data() + row;
  terms.findex = mFIndex.data() + row;
  terms.w = mW.data() + row;
  return terms;
}

/// Constraints count their rows from 0.
void FastConstraintSolver::count_from(int begin, int end)
{
  for (int row = begin; row < end; ++row)
    if (mFIndex[row] >= 0)
      mFIndex[row] += begin;
}

/// The solvers keep the matrix twice, the second time to begin anew from.
void FastConstraintSolver::check_memory(std::size_t count) const
{
  const double rows = static_cast<double>(count);
  const double bytes = 2.0 * rows * rows * sizeof(double);
  if (bytes <= memory_limit_)
    return;
  std::ostringstream text;
  text << std::setprecision(3) << "the contacts and constraints of one group of bodies that touch have "
       << std::setprecision(9) << rows << " rows, whose matrix would take " << std::setprecision(3) << bytes / 1e9
       << " GB; world.contact_memory_limit is " << memory_limit_ / 1e9
       << " GB. Raise it, or set_constraint_solver(\"iterative\"), which needs no matrix";
  throw Error(Kind::simulation, text.str());
}

/// DART finds the group of a joint's constraint by one look at a forest of skeletons that contacts have joined, so a
/// skeleton can be in two groups. Then one group reads what the impulses of the other have left in the skeleton.
bool FastConstraintSolver::groups_share_skeletons()
{
  std::set<const dart::dynamics::Skeleton*> seen;
  bool shared = false;
  for (const auto& skeleton : mSkeletons)
    skeleton->setImpulseApplied(false);
  for (auto& group : mConstrainedGroups) {
    for (std::size_t i = 0; i < group.getNumConstraints(); ++i)
      group.getConstraint(i)->excite();
    for (const auto& skeleton : mSkeletons)
      if (skeleton->isImpulseApplied()) {
        shared |= !seen.insert(skeleton.get()).second;
        skeleton->setImpulseApplied(false);
      }
  }
  return shared;
}

void FastConstraintSolver::solve_lcp(std::size_t group)
{
  if (warm_start_) {
    if (warm_lcp_.solve(group, {mA, mB, mLo, mHi, mFIndex}, warm_x_)) {
      mX = warm_x_;
      return;
    }
  }
  const bool has_second = mSecondaryBoxedLcpSolver != nullptr;
  if (has_second) // the first solver overwrites its input
    mXBackup = mX;
  const bool ours = has_second && dynamic_cast<dart::constraint::DantzigBoxedLcpSolver*>(mBoxedLcpSolver.get()) != nullptr;
  const bool solved = ours ? dantzig_lcp_.solve(mA, mX, mB, mLo, mHi, mFIndex)
                           : mBoxedLcpSolver->solve(
                                 static_cast<int>(mX.size()), mA.data(), mX.data(), mB.data(), 0, mLo.data(), mHi.data(),
                                 mFIndex.data(), has_second);
  if (has_second && (!solved || mX.hasNaN()))
    solve_lcp_again();
  if (mX.hasNaN()) {
    dterr << "[FastConstraintSolver] The contact and joint impulses are not numbers; this step has none.\n";
    mX.setZero();
  }
}

void FastConstraintSolver::solve_lcp_again()
{
  problem_.give(mA, mB, mLo, mHi, mFIndex);
  mX = mXBackup;
  mSecondaryBoxedLcpSolver->solve(
      static_cast<int>(mX.size()), mA.data(), mX.data(), mB.data(), 0, mLo.data(), mHi.data(), mFIndex.data(), false);
}

} // namespace pydart2
