#include "contact/iterative_solver.hpp"

#include <algorithm>
#include <cmath>
#include <dart/collision/Contact.hpp>
#include <dart/constraint/ContactConstraint.hpp>

#include "base/checks.hpp"
#include "base/errors.hpp"

namespace pydart2 {

namespace {

using dart::constraint::ConstrainedGroup;
using dart::constraint::ContactConstraint;
using engine::Rows;
using Friction = IterativeOptions::Friction;

constexpr int none = TreeImpulses::none;
constexpr int inner_sweeps = 10; // of one block's rows

/// The velocity with which the engine takes depth away.
double engine_correction(double depth, double time_step)
{
  const double over = std::max(0.0, depth - ContactConstraint::getErrorAllowance());
  return std::min(
      over * ContactConstraint::getErrorReductionParameter() / time_step, ContactConstraint::getMaxErrorReductionVelocity());
}

using Numbers = Eigen::Map<Eigen::VectorXd>;
using ConstNumbers = Eigen::Map<const Eigen::VectorXd>;

} // namespace

Eigen::VectorXd numbers_of(const IterativeOptions& options)
{
  Eigen::VectorXd numbers(7);
  numbers << options.iterations, options.tolerance, static_cast<int>(options.friction), options.split,
      options.error_reduction, options.allowance, options.correction_speed;
  return numbers;
}

IterativeOptions options_of(const Eigen::VectorXd& numbers)
{
  check::size(numbers.size(), 7, "the options of the iterative solver");
  check::finite(VectorIn{numbers.data(), numbers.size()}, "the options of the iterative solver");
  const auto require = [](bool good, const char* what) {
    if (!good)
      throw Error(Kind::value, std::string("option ") + what);
  };
  require(numbers[0] >= 1.0 && numbers[0] <= 1e6, "'iterations' must be from 1 to 1,000,000");
  require(numbers[1] >= 0.0, "'tolerance' must not be negative");
  require(numbers[4] >= 0.0 && numbers[4] <= 1.0, "'error_reduction' must be from 0 to 1");
  require(numbers[5] >= 0.0, "'allowance' must not be negative");
  require(numbers[6] >= 0.0, "'correction_speed' must not be negative");
  IterativeOptions options;
  options.iterations = static_cast<int>(numbers[0]);
  options.tolerance = numbers[1];
  options.friction = static_cast<Friction>(static_cast<int>(numbers[2]));
  options.split = numbers[3] != 0.0;
  options.error_reduction = numbers[4];
  options.allowance = numbers[5];
  options.correction_speed = numbers[6];
  return options;
}

void IterativeSolver::begin_step(const std::vector<dart::dynamics::SkeletonPtr>& skeletons)
{
  memory.begin_step(skeletons);
  corrections_.clear();
  iterations_used_ = 0;
  residual_ = 0.0;
}

bool IterativeSolver::read(ConstrainedGroup& group)
{
  trees_.clear();
  blocks_.assign(group.getNumConstraints(), Block());
  bool known = true;
  int rows = 0;
  for (std::size_t i = 0; i < blocks_.size() && known; ++i) {
    auto& block = blocks_[i];
    const auto constraint = group.getConstraint(i);
    engine::read_rows(*constraint, block.rows);
    block.begin = rows;
    block.size = static_cast<int>(constraint->getDimension());
    rows += block.size;
    if (const auto* contact = engine::contact(*constraint)) {
      block.contact = true;
      block.depth = contact->penetrationDepth;
    }
    if (block.rows.kind == Rows::Kind::joint)
      block.bodies[0] = add(block.rows.joint.joint->getChildBodyNode(), true, known);
    else if (block.rows.kind == Rows::Kind::bodies)
      for (const std::size_t side : {0, 1})
        block.bodies[side] = add(block.rows.bodies.bodies[side], false, known);
    else
      known = false;
  }
  if (known)
    place_joints();
  return known;
}

/// Number of a body, `none` if no impulse moves it.
int IterativeSolver::add(dart::dynamics::BodyNode* body, bool joint, bool& known)
{
  if (body == nullptr || (!joint && !body->isReactive()))
    return none;
  if (body->getSkeleton()->getNumSoftBodyNodes() > 0) { // their point masses move on their own
    known = false;
    return none;
  }
  const int number = trees_.add(*body);
  trees_.need(number, 0);
  return number;
}

void IterativeSolver::place_joints()
{
  trees_.prepare();
  starts_.resize(static_cast<std::size_t>(trees_.size()));
  tree_parts_.clear();
  int rows = 0;
  for (int body = 0; body < trees_.size(); ++body) {
    const auto tree = static_cast<std::size_t>(trees_.tree(body));
    tree_parts_.resize(std::max(tree_parts_.size(), tree + 1));
    starts_[static_cast<std::size_t>(body)] = tree_parts_[tree].size;
    tree_parts_[tree].size += trees_.dofs(body);
  }
  for (auto& part : tree_parts_) {
    part.start = rows;
    rows += part.size;
  }
  velocities_.setZero(rows);
}

void IterativeSolver::push(const Block& block, int row)
{
  if (block.rows.kind == Rows::Kind::bodies) {
    for (const std::size_t side : {0, 1})
      if (block.bodies[side] != none)
        trees_.push(block.bodies[side], block.rows.bodies.directions[side].col(row));
    return;
  }
  const auto& active = block.rows.joint.active;
  std::size_t dof = 0;
  for (int before = row; !active[dof] || before-- > 0;)
    ++dof;
  trees_.push_joint(block.bodies[0], static_cast<int>(dof));
  if (const int start = starts_[static_cast<std::size_t>(block.bodies[0])]; trees_.dofs(block.bodies[0]) > 0)
    J_[block.data + static_cast<std::size_t>(start) + dof + static_cast<std::size_t>(row * block.parts[0].size)] = 1.0;
}

/// Rows, columns of M^-1 J' and the square of A of a block.
void IterativeSolver::fill(Block& block, double time_step)
{
  const auto [a, b] = block.bodies;
  std::array<int, 2> trees{a == none ? none : trees_.tree(a), b == none ? none : trees_.tree(b)};
  const bool one_tree = trees[0] == trees[1];
  for (const std::size_t side : {0, 1})
    if (trees[side] != none && !(side == 1 && one_tree))
      block.parts[side] = tree_parts_[static_cast<std::size_t>(trees[side])];
  const int length = block.parts[0].size + block.parts[1].size;
  block.data = J_.size();
  J_.resize(J_.size() + static_cast<std::size_t>(length * block.size), 0.0);
  Y_.resize(J_.size(), 0.0);
  for (int row = 0; row < block.size; ++row) {
    push(block, row);
    const auto at = block.data + static_cast<std::size_t>(row * length);
    const std::array<std::size_t, 2> places{at, one_tree ? at : at + static_cast<std::size_t>(block.parts[0].size)};
    if (block.rows.kind == Rows::Kind::bodies)
      for (const std::size_t side : {0, 1})
        if (block.bodies[side] != none)
          trees_.add_generalised(
              block.bodies[side], block.rows.bodies.directions[side].col(row), starts_, J_.data() + places[side]);
    trees_.solve(a, b, 0);
    for (const std::size_t side : {0, 1})
      if (block.parts[side].size > 0)
        for (int body = trees_.first(trees[side]); body != none; body = trees_.next(body))
          for (int dof = 0; dof < trees_.dofs(body); ++dof)
            Y_[places[side] + static_cast<std::size_t>(starts_[static_cast<std::size_t>(body)] + dof)]
                = trees_.joint_velocity_change(body, dof);
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> J(J_.data() + block.data, block.size, length), Y(Y_.data() + block.data, block.size, length);
  block.W = J * Y.transpose();
  block.mixing = block.W.diagonal() * block.rows.force_mixing;
  if (block.contact)
    for (int row = 1; row < block.size; ++row)
      block.mixing[row] += block.rows.bodies.slip[static_cast<std::size_t>(row - 1)] / time_step;
  block.W.diagonal() += block.mixing;
  block.movable = block.W.diagonal().minCoeff() > 0.0;
  if (block.movable)
    block.inverse = block.W.inverse();
}

double IterativeSolver::read_velocity(const Block& block, int row) const
{
  const auto [first, second] = block.parts;
  const double* J = J_.data() + block.data + static_cast<std::size_t>(row * (first.size + second.size));
  double sum = ConstNumbers(J, first.size).dot(velocities_.segment(first.start, first.size));
  if (second.size > 0)
    sum += ConstNumbers(J + first.size, second.size).dot(velocities_.segment(second.start, second.size));
  return sum;
}

void IterativeSolver::change_velocity(const Block& block, int row, double impulse)
{
  const auto [first, second] = block.parts;
  const double* Y = Y_.data() + block.data + static_cast<std::size_t>(row * (first.size + second.size));
  velocities_.segment(first.start, first.size) += impulse * ConstNumbers(Y, first.size);
  if (second.size > 0)
    velocities_.segment(second.start, second.size) += impulse * ConstNumbers(Y + first.size, second.size);
}

/// Takes the engine's correction of depth out of the right-hand sides; a bounce, which the engine prefers to it where it
/// is faster, stays.
void IterativeSolver::separate_corrections(RowTerms& terms, double time_step)
{
  for (const auto& block : blocks_) {
    if (!block.contact)
      continue;
    double approach = 0.0;
    for (const std::size_t side : {0, 1})
      if (const auto* body = block.rows.bodies.bodies[side])
        approach -= block.rows.bodies.directions[side].col(0).dot(body->getSpatialVelocity());
    double& b = terms.b[block.begin];
    if (b - approach <= engine_correction(block.depth, time_step) + 1e-12)
      b = approach;
  }
}

void IterativeSolver::solve(
    ConstrainedGroup& group, RowTerms terms, double time_step, bool warm, Eigen::VectorXd& x)
{
  J_.clear();
  Y_.clear();
  x.setZero();
  for (auto& block : blocks_)
    fill(block, time_step);
  if (options.split)
    separate_corrections(terms, time_step);
  for (std::size_t i = 0; i < blocks_.size() && warm; ++i) {
    const auto& block = blocks_[i];
    memory.recall(*group.getConstraint(i), block.rows, x.segment(block.begin, block.size));
  }
  frozen_.setZero(options.friction == Friction::engine ? x.size() : 0);
  if (options.friction == Friction::engine) { // first without friction
    Eigen::VectorXd normal = x;
    sweep_until_done(terms, normal);
    frozen_ = normal;
  }
  sweep_until_done(terms, x);
  residual_ = std::max(residual_, measure(terms, x));
  for (std::size_t i = 0; i < blocks_.size() && warm; ++i) {
    const auto& block = blocks_[i];
    memory.remember(*group.getConstraint(i), block.rows, x.segment(block.begin, block.size));
  }
  if (options.split)
    find_corrections(terms, time_step);
}

void IterativeSolver::sweep_until_done(const RowTerms& terms, Eigen::VectorXd& x)
{
  velocities_.setZero();
  for (const auto& block : blocks_) {
    auto part = SmallVector(x.segment(block.begin, block.size));
    project(block, terms, part);
    x.segment(block.begin, block.size) = part;
    for (int row = 0; row < block.size; ++row)
      change_velocity(block, row, part[row]);
  }
  Eigen::VectorXd along_x = Eigen::VectorXd::Zero(x.size()), along_velocities = Eigen::VectorXd::Zero(velocities_.size());
  Eigen::VectorXd last_x, last_velocities;
  double last_square = 0.0;
  int sweep = 0;
  while (sweep < options.iterations) {
    last_x = x;
    last_velocities = velocities_;
    double change = 0.0;
    for (const auto& block : blocks_)
      change = std::max(change, solve_block(block, terms, x));
    if (++sweep == options.iterations || change <= options.tolerance)
      break; // what is handed out is within its bounds
    last_x = x - last_x;
    last_velocities = velocities_ - last_velocities;
    const double square = last_x.squaredNorm(), share = sweep == 1 ? 0.0 : square / last_square;
    last_square = square;
    if (share > 1.0) {
      along_x.setZero();
      along_velocities.setZero();
      continue;
    }
    x += share * along_x;
    velocities_ += share * along_velocities;
    along_x = share * along_x + last_x;
    along_velocities = share * along_velocities + last_velocities;
  }
  iterations_used_ = std::max(iterations_used_, sweep);
}

/// Bounds of a row, where a friction row follows the impulses x of its block.
void IterativeSolver::bound(
    const Block& block, int row, const RowTerms& terms, const SmallVector& x, double& lo, double& hi) const
{
  const int all = block.begin + row, normal = terms.findex[all];
  lo = terms.lo[all];
  hi = terms.hi[all];
  if (normal < 0)
    return;
  const double force = frozen_.size() > 0 ? frozen_[normal] : x[normal - block.begin];
  lo *= std::abs(force);
  hi *= std::abs(force);
}

void IterativeSolver::project(const Block& block, const RowTerms& terms, SmallVector& x) const
{
  const bool cone = block.contact && block.size == 3 && options.friction == Friction::cone;
  for (int row = 0; row < (cone ? 1 : block.size); ++row) {
    double lo, hi;
    bound(block, row, terms, x, lo, hi);
    x[row] = std::clamp(x[row], lo, hi);
  }
  if (!cone)
    return;
  double lo, first, second;
  bound(block, 1, terms, x, lo, first);
  bound(block, 2, terms, x, lo, second);
  if (first <= 0.0 || second <= 0.0) {
    x[1] = x[2] = 0.0;
    return;
  }
  // An ellipse where the coefficients differ: not the nearest point of it, but that along the ray, which is on the same
  // side and has the same fixed points for a circle.
  if (const double out = std::hypot(x[1] / first, x[2] / second); out > 1.0) {
    x[1] /= out;
    x[2] /= out;
  }
}

/// Solves the rows of a block with all others as they are; the largest change of a velocity.
double IterativeSolver::solve_block(const Block& block, const RowTerms& terms, Eigen::VectorXd& x)
{
  if (!block.movable)
    return 0.0;
  SmallVector old = x.segment(block.begin, block.size), w(block.size);
  for (int row = 0; row < block.size; ++row)
    w[row] = read_velocity(block, row) + block.mixing[row] * old[row] - terms.b[block.begin + row];
  SmallVector y = old - block.inverse * w, inside = y;
  project(block, terms, inside);
  if (inside != y) {
    y = old;
    const bool cone = block.contact && block.size == 3 && options.friction == Friction::cone;
    for (int sweep = 0; sweep < inner_sweeps; ++sweep) {
      const SmallVector last = y;
      for (int row = 0; row < (cone ? 1 : block.size); ++row) {
        double lo, hi;
        bound(block, row, terms, y, lo, hi);
        y[row] = std::clamp(y[row] - (w[row] + block.W.row(row).dot(y - old)) / block.W(row, row), lo, hi);
      }
      if (cone) {
        const double scale = block.W(1, 1) + block.W(2, 2);
        const double first = w[1] + block.W.row(1).dot(y - old), second = w[2] + block.W.row(2).dot(y - old);
        y[1] -= first / scale;
        y[2] -= second / scale;
        project(block, terms, y);
      }
      if ((y - last).cwiseAbs().dot(block.W.diagonal()) <= 0.1 * options.tolerance)
        break;
    }
  }
  double change = 0.0;
  for (int row = 0; row < block.size; ++row) {
    const double more = y[row] - old[row];
    if (more == 0.0)
      continue;
    change_velocity(block, row, more);
    change = std::max(change, block.W(row, row) * std::abs(more));
  }
  x.segment(block.begin, block.size) = y;
  return change;
}

double IterativeSolver::measure(const RowTerms& terms, const Eigen::VectorXd& x) const
{
  double largest = 0.0;
  for (const auto& block : blocks_) {
    if (!block.movable)
      continue;
    const SmallVector now = x.segment(block.begin, block.size);
    for (int row = 0; row < block.size; ++row) {
      const double w = read_velocity(block, row) + block.mixing[row] * now[row] - terms.b[block.begin + row];
      SmallVector next = now;
      next[row] -= w / block.W(row, row);
      double lo, hi;
      bound(block, row, terms, now, lo, hi);
      if (block.contact && row > 0 && options.friction == Friction::cone)
        project(block, terms, next);
      else
        next[row] = std::clamp(next[row], lo, hi);
      largest = std::max(largest, block.W(row, row) * std::abs(next[row] - now[row]));
    }
  }
  return largest;
}

/// Velocities that take away, for one step, what is too deep: of the normal rows, and such that constraints without a
/// limit of force keep what they hold.
void IterativeSolver::find_corrections(const RowTerms& terms, double time_step)
{
  const auto deep = [this](const Block& block) { return block.contact && block.depth > options.allowance; };
  if (std::none_of(blocks_.begin(), blocks_.end(), deep))
    return;
  velocities_.setZero();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(terms.b.size());
  double change = INFINITY;
  for (int sweep = 0; sweep < options.iterations && change > options.tolerance; ++sweep) {
    change = 0.0;
    for (const auto& block : blocks_)
      for (int row = 0; row < (block.contact ? 1 : block.size); ++row) {
        const int all = block.begin + row;
        if (!(block.W(row, row) > 0.0) || (std::isfinite(terms.lo[all]) && std::isfinite(terms.hi[all])))
          continue;
        double wanted = 0.0;
        if (block.contact) {
          const double over = block.depth - options.allowance;
          wanted = over < 0.0 ? over / time_step
                              : std::min(options.error_reduction * over / time_step, options.correction_speed);
        }
        const double w = read_velocity(block, row) + block.mixing[row] * x[all] - wanted;
        const double more = std::clamp(x[all] - w / block.W(row, row), terms.lo[all], terms.hi[all]) - x[all];
        change_velocity(block, row, more);
        x[all] += more;
        change = std::max(change, block.W(row, row) * std::abs(more));
      }
  }
  for (int body = 0; body < trees_.size(); ++body) {
    const int start = tree_parts_[static_cast<std::size_t>(trees_.tree(body))].start + starts_[static_cast<std::size_t>(body)];
    if (const Eigen::VectorXd u = velocities_.segment(start, trees_.dofs(body)); u.size() > 0 && u.allFinite() && !u.isZero(0.0))
      corrections_.push_back({trees_.node(body).getParentJoint(), u, {}});
  }
}

void IterativeSolver::apply(ConstrainedGroup& group, double time_step, Eigen::VectorXd& x) const
{
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const auto& block = blocks_[i];
    auto& constraint = *group.getConstraint(i);
    double* impulse = x.data() + block.begin;
    if (!engine::store_force(constraint, impulse, time_step)) {
      constraint.applyImpulse(impulse);
      constraint.excite();
      continue;
    }
    for (const std::size_t side : {0, 1}) {
      if (block.bodies[side] == none)
        continue;
      auto& body = *block.rows.bodies.bodies[side];
      const Eigen::Vector6d sum = block.rows.bodies.directions[side] * x.segment(block.begin, block.size);
      body.setConstraintImpulse(body.getConstraintImpulse() + sum);
      body.getSkeleton()->setImpulseApplied(true);
    }
  }
}

void IterativeSolver::add_corrections()
{
  for (auto& correction : corrections_) {
    correction.saved = correction.joint->getVelocities();
    correction.joint->setVelocities(correction.saved + correction.velocity);
  }
}

void IterativeSolver::take_off_corrections()
{
  for (auto correction = corrections_.rbegin(); correction != corrections_.rend(); ++correction)
    correction->joint->setVelocities(correction->saved);
  corrections_.clear();
}

} // namespace pydart2
