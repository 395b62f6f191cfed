#include "contact/iterative_solver.hpp"

#include <algorithm>
#include <dart/common/Console.hpp>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"
#include "contact/contact_reduction.hpp"

namespace pydart2 {

namespace {

using dart::dynamics::BodyNode;
using engine::Rows;

constexpr int none = Movers::none;
/// A detector that does not see what nearly touches loses contacts whose depth is taken away.
constexpr double least_allowance_without_gaps = 1e-4;

} // namespace

void IterativeSolver::begin_step(
    const std::vector<dart::dynamics::SkeletonPtr>& skeletons, bool same, FreeBodies* free)
{
  memory.begin_step(skeletons, same);
  reader_.begin(same, free);
  contacts_.clear();
  constraints_.clear();
  movers_.begin(free);
  corrections_.clear();
  iterations_used_ = 0;
  residual_ = 0.0;
}

bool IterativeSolver::knows(const dart::constraint::ConstraintBase& constraint)
{
  Rows rows;
  engine::read_rows(constraint, rows);
  return rows.kind != Rows::Kind::unknown;
}

void IterativeSolver::solve(double time_step, bool warm, bool reduce, bool doubt)
{
  if (doubt)
    doubt_depths(contacts_);
  if (reduce)
    keep_extremal_contacts(contacts_);
  share_slip(contacts_);
  find_sources();
  movers_.prepare();
  find_islands();
  place_velocities();
  place_blocks();
  fill(time_step);
  system_.x.setZero(system_.b.size());
  if (warm)
    recall();
  sweep(time_step, doubt ? std::max(options.allowance, least_allowance_without_gaps) : options.allowance);
  if (warm)
    remember();
  if (options.split)
    calm();
  apply(time_step);
}

void IterativeSolver::find_sources()
{
  sources_.clear();
  rows_.resize(constraints_.size());
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    engine::read_rows(*constraints_[i], rows_[i]);
    sources_.push_back({static_cast<int>(i), none, {}});
    if (rows_[i].kind == Rows::Kind::joint) // first: such a body is no free one
      sources_.back().places[0] = movers_.add_joint(*rows_[i].joint.joint->getChildBodyNode());
  }
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    if (rows_[i].kind == Rows::Kind::bodies)
      for (const std::size_t side : {0, 1})
        sources_[i].places[side] = movers_.add(rows_[i].bodies.bodies[side]);
  BodyNode* bodies[2] = {nullptr, nullptr}; // contacts of a pair follow each other
  std::array<Movers::Place, 2> places;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    for (const std::size_t side : {0, 1})
      if (bodies[side] != contacts_[i].bodies[side])
        places[side] = movers_.add(bodies[side] = contacts_[i].bodies[side], contacts_[i].free[side]);
    sources_.push_back({none, static_cast<int>(i), places});
  }
  const auto moves_nothing = [](const Source& source) { return source.places[0].mover == none && source.places[1].mover == none; };
  sources_.erase(std::remove_if(sources_.begin(), sources_.end(), moves_nothing), sources_.end());
  for (std::size_t i = 0; i < sources_.size(); ++i)
    sources_[i].order = static_cast<int>(i);
}

/// Sorts the sources by what they move together, and then from the top: what is next to the ground is solved last, and holds.
void IterativeSolver::find_islands()
{
  std::vector<int> root(static_cast<std::size_t>(movers_.size()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int mover) {
    auto i = static_cast<std::size_t>(mover);
    while (root[i] != static_cast<int>(i))
      i = static_cast<std::size_t>(root[i] = root[static_cast<std::size_t>(root[i])]);
    return i;
  };
  for (const auto& source : sources_)
    if (source.places[0].mover != none && source.places[1].mover != none)
      root[find(source.places[1].mover)] = static_cast<int>(find(source.places[0].mover));
  system_.islands.clear();
  std::vector<int> numbers(root.size(), none);
  for (auto& source : sources_) {
    int& number = numbers[find(source.places[source.places[0].mover == none].mover)];
    if (number == none) {
      number = static_cast<int>(system_.islands.size());
      system_.islands.emplace_back();
    }
    source.island = number;
  }
  island_of_.resize(root.size());
  for (std::size_t mover = 0; mover < root.size(); ++mover)
    island_of_[mover] = numbers[find(static_cast<int>(mover))];
  find_steps();
  const auto sooner = [](const Source& a, const Source& b) { return a.island != b.island ? a.island < b.island : a.steps > b.steps; };
  if (!std::is_sorted(sources_.begin(), sources_.end(), sooner))
    std::stable_sort(sources_.begin(), sources_.end(), sooner);
  for (auto first = sources_.begin(); first != sources_.end();) { // of two bodies the last point first: stacks sway less
    const auto last = std::find_if(first, sources_.end(), [&](const Source& source) { return !source.joins_as(*first); });
    std::reverse(first, last);
    first = last;
  }
  blocks_.resize(sources_.size());
  for (std::size_t i = 0; i < sources_.size(); ++i)
    blocks_[static_cast<std::size_t>(sources_[i].order)] = i;
}

/// Over how many others each source rests on what nothing moves: breadth first, so that it is linear in their number.
void IterativeSolver::find_steps()
{
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  thread_local std::vector<std::size_t> ends, begins; // of each mover's part of `touching`
  thread_local std::vector<int> touching, reached;
  ends.assign(index(movers_.size()) + 1, 0);
  for (const auto& source : sources_)
    for (const auto& place : source.places)
      if (place.mover != none)
        ++ends[index(place.mover)];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  touching.resize(ends.back());
  reached.clear();
  begins = ends;
  for (std::size_t i = sources_.size(); i-- > 0;)
    for (const auto& place : sources_[i].places)
      if (place.mover != none)
        touching[--begins[index(place.mover)]] = static_cast<int>(i);
  constexpr int far = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    auto& source = sources_[i];
    const bool one_side = source.places[0].mover == none || source.places[1].mover == none;
    const bool joint = source.constraint != none && rows_[index(source.constraint)].kind == Rows::Kind::joint;
    source.steps = one_side && !joint ? 0 : far;
    if (source.steps == 0)
      reached.push_back(static_cast<int>(i));
  }
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (const auto& place : sources_[index(reached[next])].places)
      if (place.mover != none)
        for (auto& k = begins[index(place.mover)]; k < ends[index(place.mover)]; ++k) // each mover's once
          if (auto& other = sources_[index(touching[k])]; other.steps == far) {
            other.steps = sources_[index(reached[next])].steps + 1;
            reached.push_back(touching[k]);
          }
}

void IterativeSolver::place_velocities()
{
  const auto island = [this](int mover) -> BlockSystem::Island* {
    const int number = island_of_[static_cast<std::size_t>(mover)];
    return number == none ? nullptr : &system_.islands[static_cast<std::size_t>(number)];
  };
  for (int mover = 0; mover < movers_.size(); ++mover)
    if (auto* its = island(mover)) {
      movers_.set_start(mover, its->size);
      its->size += movers_.dofs(mover);
      its->calms &= options.split && movers_.free(mover);
    }
  int size = 0;
  for (auto& each : system_.islands) {
    each.start = size;
    size += each.size;
  }
  for (int mover = 0; mover < movers_.size(); ++mover)
    if (const auto* its = island(mover))
      movers_.set_start(mover, its->start + movers_.start(mover));
  system_.velocities.setZero(size);
}

void IterativeSolver::recall()
{
  keys_.clear();
  for (const std::size_t i : blocks_) {
    const auto& block = system_.blocks[i];
    auto x = system_.x.segment(block.row, block.size);
    if (!block.contact) {
      keys_.push_back(memory.key(rows_[static_cast<std::size_t>(sources_[i].constraint)]));
      x = memory.recall(keys_.back()).head(block.size);
      continue;
    }
    const auto& terms = contacts_[static_cast<std::size_t>(sources_[i].contact)];
    keys_.push_back(terms.touch == nullptr ? memory.key(*terms.contact) : memory.key(*terms.touch));
    const Eigen::Vector3d impulse = memory.recall(keys_.back()).head<3>();
    for (int row = 0; row < block.size; ++row)
      x[row] = impulse.dot(terms.directions[static_cast<std::size_t>(row)]);
  }
}

void IterativeSolver::remember()
{
  for (const std::size_t i : blocks_) {
    const auto& block = system_.blocks[i];
    const auto x = system_.x.segment(block.row, block.size);
    Eigen::Vector6d impulses = Eigen::Vector6d::Zero();
    if (!block.contact)
      impulses.head(block.size) = x;
    else
      for (int row = 0; row < block.size; ++row)
        impulses.head<3>()
            += x[row] * contacts_[static_cast<std::size_t>(sources_[i].contact)].directions[static_cast<std::size_t>(row)];
    memory.remember(keys_[static_cast<std::size_t>(sources_[i].order)], impulses);
  }
}

void IterativeSolver::sweep(double time_step, double allowance)
{
  auto used = options;
  used.allowance = allowance;
  corrected_.setZero(options.split ? system_.velocities.size() : 0);
  const auto threads = std::min(static_cast<std::size_t>(options.threads), system_.islands.size());
  std::vector<Swept> swept(std::max<std::size_t>(threads, 1));
  const auto solve_share = [&](std::size_t share) {
    Sweeps sweeps(system_, used);
    for (std::size_t i = share; i < system_.islands.size(); i += swept.size())
      solve_island(system_.islands[i], time_step, sweeps, swept[share]);
  };
  parallel_for(swept.size(), swept.size(), solve_share);
  bool corrects = false;
  for (const auto& share : swept) {
    iterations_used_ = std::max(iterations_used_, share.sweeps);
    residual_ = std::max(residual_, share.residual);
    corrects |= share.corrects;
  }
  if (!system_.x.allFinite() || !system_.velocities.allFinite()) {
    dterr << "[IterativeSolver] The contact and joint impulses are not numbers; this step has none.\n";
    system_.x.setZero();
    system_.velocities.setZero();
  } else if (corrects) {
    keep_corrections();
  }
}

void IterativeSolver::solve_island(const BlockSystem::Island& island, double time_step, Sweeps& sweeps, Swept& all)
{
  sweeps.prepare(island);
  const auto one = sweeps.solve(island);
  all.sweeps = std::max(all.sweeps, one.sweeps);
  all.residual = std::max(all.residual, one.residual);
  if (options.split)
    all.corrects |= sweeps.find_corrections(island, time_step, corrected_);
}

/// Sweeps leave velocities of the size of their tolerance, and walls sway by what all of their rows have left: a body
/// that is slow loses as much of its speed.
void IterativeSolver::calm()
{
  movers_.calm(system_.velocities, 2.0 * options.noise(), 100.0 * options.noise());
}

void IterativeSolver::keep_corrections()
{
  if (corrected_.allFinite())
    movers_.correct_free(corrected_);
  movers_.each_joint(corrected_, [this](double* velocities, const auto& change) {
    for (Eigen::Index i = 0; i < change.size() && change.allFinite(); ++i)
      corrections_.push_back({velocities + i, change[i], 0.0});
  });
}

void IterativeSolver::move_free_bodies(double time_step)
{
  movers_.move_free(system_.velocities, time_step);
}

void IterativeSolver::add_corrections()
{
  for (auto& correction : corrections_) {
    correction.saved = *correction.velocity;
    *correction.velocity += correction.change;
  }
}

void IterativeSolver::take_off_corrections()
{
  for (auto correction = corrections_.rbegin(); correction != corrections_.rend(); ++correction)
    *correction->velocity = correction->saved;
  corrections_.clear();
}

} // namespace pydart2
