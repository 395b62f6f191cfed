#include "contact/block_system.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/newton_steps.hpp"

namespace pydart2 {

namespace {

using Friction = IterativeOptions::Friction;

constexpr int inner_sweeps = 10; // of one block's rows
constexpr double rough = 1e-2; // m/s: a residual with which bodies visibly get into each other
constexpr int newton_steps = 20;
constexpr double deep = 2.0; // allowances, at least, is what is corrected
constexpr double nearly = 4.0; // tolerances: a change with which the residual may be small
constexpr double quiet = 0.3; // of the tolerance: two bodies that changed less are not solved twice in a sweep

} // namespace

/// A block of R rows at parts of A and B velocities; Eigen::Dynamic for any number.
template <int R, int A, int B>
struct Sweeps::View
{
  static constexpr int most = R == Eigen::Dynamic ? 6 : R;
  static constexpr bool both = B != 0;
  template <int N>
  using Rows = Eigen::Map<Eigen::Matrix<double, R, N, N == 1 ? Eigen::ColMajor : Eigen::RowMajor>>;
  template <int N>
  using Segment = Eigen::Map<Eigen::Matrix<double, N, 1>>;
  using Vector = Eigen::Matrix<double, R, 1, Eigen::ColMajor, most, 1>;
  using Square = Eigen::Map<Eigen::Matrix<double, R, R>>;
  static constexpr int second = both ? B : 1; // Eigen has no maps of nothing

  View(BlockSystem& system, const Block& block, double* velocities)
    : block(block),
      Ja(system.J(block, 0), block.size, block.sizes[0]),
      Ya(system.Y(block, 0), block.size, block.sizes[0]),
      Jb(system.J(block, 1), block.size, both ? block.sizes[1] : 1),
      Yb(system.Y(block, 1), block.size, both ? block.sizes[1] : 1),
      va(velocities + block.starts[0], block.sizes[0]),
      vb(velocities + block.starts[1], both ? block.sizes[1] : 1),
      W(system.W(block), block.size, block.size),
      inverse(system.W(block) + block.size * block.size, block.size, block.size),
      x(system.x.data() + block.row, block.size),
      b(system.b.data() + block.row, block.size),
      mixing(system.mixing.data() + block.row, block.size)
  {}

  Vector velocity() const
  {
    Vector sum = Ja * va;
    if constexpr (both)
      sum.noalias() += Jb * vb;
    return sum;
  }

  template <class Change>
  void change(const Change& impulses)
  {
    va.noalias() += Ya.transpose() * impulses;
    if constexpr (both)
      vb.noalias() += Yb.transpose() * impulses;
  }

  double velocity(int row) const
  {
    double sum = Ja.row(row).dot(va);
    if constexpr (both)
      sum += Jb.row(row).dot(vb);
    return sum;
  }

  void change(int row, double impulse)
  {
    va += impulse * Ya.row(row).transpose();
    if constexpr (both)
      vb += impulse * Yb.row(row).transpose();
  }

  const Block& block;
  Rows<A> Ja, Ya;
  Rows<second> Jb, Yb;
  Segment<A> va;
  Segment<second> vb;
  Square W, inverse;
  Eigen::Map<Eigen::Matrix<double, R, 1>> x, b, mixing;
};

/// Contacts with friction of bodies that are free, those of trees, and all else.
template <class Do>
auto Sweeps::with_view(const Block& block, const Do& act)
{
  constexpr int any = Eigen::Dynamic;
  const bool one = block.sizes[1] == 0;
  if (block.size == 3 && block.sizes[0] == 6 && one) {
    View<3, 6, 0> view(system_, block, velocities_);
    return act(view);
  }
  if (block.size == 3 && block.sizes[0] == 6 && block.sizes[1] == 6) {
    View<3, 6, 6> view(system_, block, velocities_);
    return act(view);
  }
  if (block.size == 3 && one) {
    View<3, any, 0> view(system_, block, velocities_);
    return act(view);
  }
  if (block.size == 3) {
    View<3, any, any> view(system_, block, velocities_);
    return act(view);
  }
  View<any, any, any> view(system_, block, velocities_);
  return act(view);
}

void Sweeps::prepare(const Island& island)
{
  for (int i = island.first; i < island.last; ++i) {
    auto& block = system_.blocks[static_cast<std::size_t>(i)];
    with_view(block, [this, &block](auto& view) {
      view.W = view.Ja.lazyProduct(view.Ya.transpose());
      if constexpr (std::decay_t<decltype(view)>::both)
        view.W += view.Jb.lazyProduct(view.Yb.transpose());
      const typename std::decay_t<decltype(view)>::Vector mixed = block.force_mixing * view.W.diagonal();
      if (block.contact && options_.split) // of what changes since the last step: what carries the same for long does not give way
        view.b += mixed.cwiseProduct(view.x);
      view.mixing += mixed;
      view.W.diagonal() += view.mixing;
      const double most = view.W.diagonal().maxCoeff();
      block.movable = most > 0.0;
      for (int row = 0; row < block.size; ++row)
        if (view.W(row, row) <= 1e-14 * most) { // moves nothing, as a force across a planar robot; the others do
          view.W(row, row) = most;
          view.b[row] = 0.0;
        }
      if (block.movable)
        view.inverse = view.W.inverse();
    });
  }
}

Swept Sweeps::solve(const Island& island)
{
  int sweeps = 0;
  frozen_.resize(0);
  if (options_.friction == Friction::engine) { // first without friction
    const Eigen::VectorXd begun = system_.x.segment(island.row, island.rows);
    frozen_.setZero(island.rows);
    frozen_row_ = island.row;
    begin(island);
    sweeps = sweep(island).sweeps;
    frozen_ = system_.x.segment(island.row, island.rows);
    system_.x.segment(island.row, island.rows) = begun;
  }
  begin(island);
  Swept swept = sweep(island);
  swept.sweeps = std::max(swept.sweeps, sweeps);
  if (swept.residual > rough && island.rows <= NewtonSteps::most_rows)
    swept.residual = refine(island, swept.residual);
  return swept;
}

/// The velocities of the impulses that the sweeps begin with.
void Sweeps::begin(const Island& island)
{
  system_.velocities.segment(island.start, island.size).setZero();
  for (int i = island.first; i < island.last; ++i)
    with_view(system_.blocks[static_cast<std::size_t>(i)], [this](auto& view) {
      typename std::decay_t<decltype(view)>::Vector x = view.x;
      project(view, x);
      view.x = x;
      view.change(x);
    });
}

/// Until the residual is small. It is looked at where a sweep changes little, if not less than the tolerance: where fewer
/// points would carry the load, it moves from one to the other for good.
Swept Sweeps::sweep(const Island& island)
{
  if (island.calms)
    if (const double residual = measure(island); residual <= options_.noise())
      return {0, residual};
  auto x = system_.x.segment(island.row, island.rows);
  auto velocities = system_.velocities.segment(island.start, island.size);
  along_x_.setZero(island.rows);
  along_velocities_.setZero(island.size);
  double last_square = 0.0;
  for (int sweep = 1;; ++sweep) {
    last_x_ = x;
    last_velocities_ = velocities;
    const double change = pass(island);
    const bool last = sweep == options_.iterations;
    if (last || change <= nearly * options_.tolerance)
      if (const double residual = measure(island); last || residual <= options_.tolerance)
        return {sweep, residual}; // what is handed out is within its bounds
    last_x_ = x - last_x_;
    last_velocities_ = velocities - last_velocities_;
    const double square = last_x_.squaredNorm(), share = sweep == 1 ? 0.0 : square / last_square;
    last_square = square;
    if (!(share <= 1.0)) { // or a part of nothing, where a second turn takes back the first
      along_x_.setZero();
      along_velocities_.setZero();
      continue;
    }
    x += share * along_x_;
    velocities += share * along_velocities_;
    along_x_ = share * along_x_ + last_x_;
    along_velocities_ = share * along_velocities_ + last_velocities_;
  }
}

/// Each block once, and once more where those of the same two bodies have not come to rest; the largest change of a velocity.
double Sweeps::pass(const Island& island)
{
  double change = 0.0;
  const auto block = [this](int i) -> const Block& { return system_.blocks[static_cast<std::size_t>(i)]; };
  for (int first = island.first, last; first < island.last; first = last) {
    double most = 0.0;
    for (last = first; last < island.last && block(last).joins_as(block(first)); ++last)
      most = std::max(most, with_view(block(last), [this](auto& view) { return solve_block(view); }));
    if (last > first + 1 && most > quiet * options_.tolerance)
      for (int i = first; i < last; ++i)
        with_view(block(i), [this](auto& view) { return solve_block(view); });
    change = std::max(change, most);
  }
  return change;
}

/// Where sweeps do not get near, as with a light body below a heavy one: the residual of the best that was found.
double Sweeps::refine(const Island& island, double residual)
{
  NewtonSteps newton(system_, island, options_.friction == Friction::cone, frozen_);
  auto x = system_.x.segment(island.row, island.rows);
  last_x_ = x;
  for (int step = 0; step < newton_steps && residual > options_.tolerance && x.allFinite(); ++step) {
    newton.step();
    begin(island);
    pass(island);
    if (const double now = measure(island); now < residual) {
      residual = now;
      last_x_ = x;
    }
  }
  x = last_x_;
  begin(island);
  return residual;
}

/// Bounds of a row, where a friction row follows the impulses x of its block.
template <class V, class Vector>
void Sweeps::bounds(const V& view, int row, const Vector& x, double& lo, double& hi) const
{
  lo = system_.lo[view.block.row + row];
  hi = system_.hi[view.block.row + row];
  if (row == 0 || !view.block.contact)
    return;
  const double force = std::abs(frozen_.size() > 0 ? frozen_[view.block.row - frozen_row_] : x[0]);
  lo *= force;
  hi *= force;
}

template <class V>
bool Sweeps::is_cone(const V& view) const
{
  return view.block.contact && view.block.size == 3 && options_.friction == Friction::cone;
}

template <class V, class Vector>
void Sweeps::project(const V& view, Vector& x) const
{
  const bool cone = is_cone(view);
  for (int row = 0; row < (cone ? 1 : view.block.size); ++row) {
    double lo, hi;
    bounds(view, row, x, lo, hi);
    x[row] = std::clamp(x[row], lo, hi);
  }
  if (!cone)
    return;
  double lo, first, second;
  bounds(view, 1, x, lo, first);
  bounds(view, 2, x, lo, second);
  if (first <= 0.0 || second <= 0.0) {
    x[1] = x[2] = 0.0;
    return;
  }
  // An ellipse where the coefficients differ: not the nearest point of it, but that along the ray, which is on the same
  // side and has the same fixed points for a circle.
  const double along = x[1] / first, across = x[2] / second;
  if (const double out = std::sqrt(along * along + across * across); out > 1.0) {
    x[1] /= out;
    x[2] /= out;
  }
}

/// Solves the rows of a block with all others as they are; the largest change of a velocity.
template <class V>
double Sweeps::solve_block(V& view)
{
  if (!view.block.movable)
    return 0.0;
  using Vector = typename V::Vector;
  const Vector old = view.x, w = view.velocity() + view.mixing.cwiseProduct(old) - view.b;
  Vector y = old - view.inverse * w, inside = y;
  project(view, inside);
  if (inside != y) {
    y = old;
    solve_inside(view, old, w, y);
  }
  const Vector more = y - old;
  view.change(more);
  view.x = y;
  return more.cwiseAbs().cwiseProduct(view.W.diagonal()).maxCoeff();
}

/// The same where bounds hold: row by row.
template <class V, class Vector>
void Sweeps::solve_inside(const V& view, const Vector& old, const Vector& w, Vector& y) const
{
  const bool cone = is_cone(view);
  const auto velocity = [&](int row) { return w[row] + view.W.row(row).dot(y - old); };
  for (int sweep = 0; sweep < inner_sweeps; ++sweep) {
    const Vector last = y;
    for (int row = 0; row < (cone ? 1 : view.block.size); ++row) {
      double lo, hi;
      bounds(view, row, y, lo, hi);
      y[row] = std::clamp(y[row] - velocity(row) / view.W(row, row), lo, hi);
    }
    if (cone) {
      const double scale = view.W(1, 1) + view.W(2, 2), first = velocity(1), second = velocity(2);
      y[1] -= first / scale;
      y[2] -= second / scale;
      project(view, y);
    }
    if ((y - last).cwiseAbs().dot(view.W.diagonal()) <= 0.1 * options_.tolerance)
      return;
  }
}

/// The largest residual of a row.
double Sweeps::measure(const Island& island)
{
  double largest = 0.0;
  for (int i = island.first; i < island.last; ++i)
    if (const auto& block = system_.blocks[static_cast<std::size_t>(i)]; block.movable)
      largest = std::max(largest, with_view(block, [this](auto& view) { return residual_of(view); }));
  return largest;
}

template <class V>
double Sweeps::residual_of(V& view) const
{
  using Vector = typename V::Vector;
  const Vector now = view.x, w = view.velocity() + view.mixing.cwiseProduct(now) - view.b;
  const bool cone = is_cone(view);
  const double across = cone ? std::max(view.W(1, 1), view.W(2, 2)) : 0.0; // of both tangents
  Vector next = now;
  for (int row = 0; row < view.block.size; ++row) {
    next[row] -= w[row] / (cone && row > 0 ? across : view.W(row, row));
    double lo, hi;
    bounds(view, row, now, lo, hi);
    if (!cone || row == 0)
      next[row] = std::clamp(next[row], lo, hi);
  }
  if (cone) {
    const double normal = std::exchange(next[0], now[0]);
    project(view, next);
    next[0] = normal;
  }
  return (next - now).cwiseAbs().cwiseProduct(view.W.diagonal()).maxCoeff();
}

bool Sweeps::find_corrections(const Island& island, double time_step, Eigen::VectorXd& out)
{
  const auto first = system_.blocks.begin() + island.first, last = system_.blocks.begin() + island.last;
  if (std::none_of(first, last, [this](const Block& block) { return block.contact && block.depth > deep * options_.allowance; }))
    return false;
  velocities_ = out.data();
  auto x = Eigen::VectorXd::Zero(island.rows).eval();
  double change = INFINITY;
  const auto solve_rows = [&](auto& view) {
    const auto& block = view.block;
    for (int row = 0; row < (block.contact ? 1 : block.size); ++row) {
      const int all = block.row + row;
      if (!(view.W(row, row) > 0.0) || (std::isfinite(system_.lo[all]) && std::isfinite(system_.hi[all])))
        continue;
      double wanted = 0.0;
      if (block.contact) {
        const double over = block.depth - options_.allowance;
        wanted = over < 0.0 ? over / time_step : std::min(options_.error_reduction * over / time_step, options_.correction_speed);
      }
      double& impulse = x[all - island.row];
      const double w = view.velocity(row) + view.mixing[row] * impulse - wanted;
      const double more = std::clamp(impulse - w / view.W(row, row), system_.lo[all], system_.hi[all]) - impulse;
      view.change(row, more);
      impulse += more;
      change = std::max(change, view.W(row, row) * std::abs(more));
    }
  };
  const double enough = std::max(options_.tolerance, 0.1 * options_.allowance / time_step);
  for (int sweep = 0; sweep < options_.iterations && change > enough; ++sweep) {
    change = 0.0;
    for (auto block = first; block != last; ++block)
      with_view(*block, solve_rows);
  }
  velocities_ = system_.velocities.data();
  return true;
}

} // namespace pydart2
