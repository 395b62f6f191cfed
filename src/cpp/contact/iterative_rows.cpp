#include <algorithm>
#include <dart/constraint/ContactConstraint.hpp>
#include <limits>

#include "contact/iterative_solver.hpp"
#include "engine/tree_members.hpp"

// The rows of contacts and constraints, as the sweeps take them, and what their impulses do to bodies.

namespace pydart2 {

namespace {

using dart::constraint::ContactConstraint;
using dart::dynamics::BodyNode;
using engine::Rows;

constexpr int none = Movers::none;
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// An impulse at a point of the world, as a wrench in a body's frame.
Eigen::Vector6d wrench_at(const BodyNode& body, const Eigen::Vector3d& point, const Eigen::Vector3d& impulse)
{
  const auto& pose = body.getWorldTransform();
  const Eigen::Vector3d place = pose.linear().transpose() * (point - pose.translation());
  Eigen::Vector6d wrench;
  wrench.tail<3>() = pose.linear().transpose() * impulse;
  wrench.head<3>() = place.cross(wrench.tail<3>());
  return wrench;
}

/// The same of unit impulses along some directions, each a row.
TreeRows::Lanes wrenches_at(
    const BodyNode& body, const Eigen::Vector3d& point, const std::array<Eigen::Vector3d, 3>& directions, int count)
{
  TreeRows::Lanes wrenches = TreeRows::Lanes::Zero();
  const auto& pose = body.getWorldTransform();
  const Eigen::Vector3d place = pose.linear().transpose() * (point - pose.translation());
  for (int row = 0; row < count; ++row) {
    const Eigen::Vector3d impulse = pose.linear().transpose() * directions[static_cast<std::size_t>(row)];
    wrenches.row(row) << place.cross(impulse).transpose(), impulse.transpose();
  }
  return wrenches;
}

/// Which of a block's two parts is that of a side.
std::size_t part_of(const std::array<Movers::Place, 2>& places, std::size_t side)
{
  return side == 1 && places[0].mover != none && places[0].mover != places[1].mover ? 1 : 0;
}

} // namespace

void IterativeSolver::place_blocks()
{
  system_.blocks.clear();
  int rows = 0;
  std::size_t data = 0;
  for (const auto& source : sources_) {
    Block block;
    block.row = rows;
    block.data = data;
    block.contact = source.contact != none;
    if (block.contact)
      block.size = contacts_[static_cast<std::size_t>(source.contact)].has_friction() ? 3 : 1;
    else
      block.size = static_cast<int>(constraints_[static_cast<std::size_t>(source.constraint)]->getDimension());
    for (const std::size_t side : {0, 1})
      if (const int mover = source.places[side].mover; mover != none) {
        const auto part = part_of(source.places, side);
        block.starts[part] = movers_.start(mover);
        block.sizes[part] = std::max(block.sizes[part], movers_.columns(source.places[side]));
      }
    auto& island = system_.islands[static_cast<std::size_t>(source.island)];
    if (island.rows == 0) {
      island.first = static_cast<int>(system_.blocks.size());
      island.row = rows;
    }
    rows += block.size;
    data += block.numbers();
    system_.blocks.push_back(block);
    island.last = static_cast<int>(system_.blocks.size());
    island.rows = rows - island.row;
  }
  system_.terms.resize(data);
  for (auto* numbers : {&system_.lo, &system_.hi, &system_.b, &system_.mixing})
    numbers->resize(rows);
}

void IterativeSolver::fill(double time_step)
{
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (system_.blocks[i].contact)
      fill_contact(system_.blocks[i], sources_[i], time_step);
    else
      fill_constraint(system_.blocks[i], sources_[i], time_step);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    auto& block = system_.blocks[i];
    block.force_mixing = block.contact ? ContactConstraint::getConstraintForceMixing()
                                       : rows_[static_cast<std::size_t>(sources_[i].constraint)].force_mixing;
    if (block.contact)
      block.depth = contacts_[static_cast<std::size_t>(sources_[i].contact)].depth;
  }
}

/// Some rows of a block, at one of its parts.
Movers::Rows IterativeSolver::rows_of(const Block& block, std::size_t part, int first, int count)
{
  const int length = block.sizes[part], skipped = first * length;
  return {system_.J(block, static_cast<int>(part)) + skipped, system_.Y(block, static_cast<int>(part)) + skipped, count, length};
}

/// Rows and right-hand sides of a contact.
void IterativeSolver::fill_contact(const Block& block, const Source& source, double time_step)
{
  const auto& terms = contacts_[static_cast<std::size_t>(source.contact)];
  const auto& point = terms.contact->point;
  auto b = system_.b.segment(block.row, block.size);
  b.setZero();
  std::array<Movers::Place, 2> in_trees;
  for (const std::size_t side : {0, 1})
    if (const auto& place = source.places[side]; place.mover != none && !movers_.free(place.mover))
      in_trees[side] = place;
  const bool trees = in_trees[0].mover != none || in_trees[1].mover != none;
  if (trees) // whose rows are of the joints above alone
    std::fill_n(system_.J(block, 0), block.numbers(), 0.0);
  std::array<TreeRows::Lanes, 2> wrenches;
  std::array<Movers::Rows, 2> rows;
  for (const std::size_t side : {0, 1}) {
    const int mover = source.places[side].mover;
    const double sign = side == 0 ? 1.0 : -1.0;
    rows[side] = rows_of(block, part_of(source.places, side), 0, block.size);
    if (mover != none && movers_.free(mover)) {
      for (int row = 0; row < block.size; ++row) {
        const Eigen::Vector3d direction = sign * terms.directions[static_cast<std::size_t>(row)];
        movers_.point_row(mover, point, direction, rows[side].J + 6 * row, rows[side].Y + 6 * row);
        b[row] -= movers_.speed(mover, rows[side].J + 6 * row);
      }
    } else if (const auto* body = terms.bodies[side]; body != nullptr && (mover != none || !body->getSpatialVelocity().isZero(0.0))) {
      wrenches[side] = sign * wrenches_at(*body, point, terms.directions, block.size);
      b -= wrenches[side].topRows(block.size) * body->getSpatialVelocity();
    }
  }
  if (trees)
    movers_.wrench_rows(in_trees, wrenches, rows);
  if (terms.depth < 0.0) // may close its gap
    b[0] += terms.depth / time_step;
  else
    b[0] = parting_speed(terms, b[0], options.split ? 0.0 : engine_correction(terms.contact->penetrationDepth, time_step));
  for (int row = 0; row < block.size; ++row) {
    const auto tangent = static_cast<std::size_t>(row - 1);
    system_.lo[block.row + row] = row == 0 ? 0.0 : -terms.friction[tangent];
    system_.hi[block.row + row] = row == 0 ? unbounded : terms.friction[tangent];
    system_.mixing[block.row + row] = row == 0 ? 0.0 : terms.slip[tangent] / time_step;
  }
}

void IterativeSolver::fill_constraint(const Block& block, const Source& source, double time_step)
{
  const auto& rows = rows_[static_cast<std::size_t>(source.constraint)];
  std::fill_n(system_.J(block, 0), block.numbers(), 0.0);
  std::array<int, 6> dofs{}; // of a joint's rows
  if (rows.kind == Rows::Kind::joint)
    for (int row = 0, dof = -1; row < block.size; dofs[static_cast<std::size_t>(row++)] = dof)
      while (!rows.joint.active[static_cast<std::size_t>(++dof)]) {
      }
  for (int first = 0; first < block.size; first += TreeRows::lanes) {
    const int count = std::min(block.size - first, TreeRows::lanes);
    std::array<TreeRows::Lanes, 2> wrenches{TreeRows::Lanes::Zero(), TreeRows::Lanes::Zero()};
    std::array<Movers::Rows, 2> out;
    for (const std::size_t side : {0, 1}) {
      out[side] = rows_of(block, part_of(source.places, side), first, count);
      if (rows.kind == Rows::Kind::bodies && source.places[side].mover != none)
        wrenches[side].topRows(count) = rows.bodies.directions[side].middleCols(first, count).transpose();
    }
    if (rows.kind == Rows::Kind::joint)
      movers_.joint_rows(source.places[0], dofs.data() + first, out[0]);
    else
      movers_.wrench_rows(source.places, wrenches, out);
  }
  double x[6], w[6] = {};
  int findex[6] = {-1, -1, -1, -1, -1, -1};
  dart::constraint::ConstraintInfo info{};
  info.x = x;
  info.lo = system_.lo.data() + block.row;
  info.hi = system_.hi.data() + block.row;
  info.b = system_.b.data() + block.row;
  info.w = w;
  info.findex = findex;
  info.invTimeStep = 1.0 / time_step;
  constraints_[static_cast<std::size_t>(source.constraint)]->getInformation(&info);
  system_.mixing.segment(block.row, block.size).setZero();
}

void IterativeSolver::apply(double time_step)
{
  movers_.move_free_in_array(system_.velocities);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const auto& block = system_.blocks[i];
    const auto& source = sources_[i];
    if (block.contact) {
      apply_contact(block, source, time_step);
    } else if (const auto& rows = rows_[static_cast<std::size_t>(source.constraint)]; rows.kind == Rows::Kind::joint) {
      auto& constraint = *constraints_[static_cast<std::size_t>(source.constraint)];
      constraint.applyImpulse(system_.x.data() + block.row);
      constraint.excite();
    } else {
      engine::store_impulses(*constraints_[static_cast<std::size_t>(source.constraint)], system_.x.data() + block.row);
      for (const std::size_t side : {0, 1})
        if (source.places[side].mover != none)
          apply_wrench(
              source.places[side], *rows.bodies.bodies[side],
              rows.bodies.directions[side] * system_.x.segment(block.row, block.size));
    }
  }
}

void IterativeSolver::apply_contact(const Block& block, const Source& source, double time_step)
{
  const auto& terms = contacts_[static_cast<std::size_t>(source.contact)];
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  for (int row = 0; row < block.size; ++row)
    impulse += system_.x[block.row + row] * terms.directions[static_cast<std::size_t>(row)];
  terms.contact->force = impulse / time_step;
  for (const std::size_t side : {0, 1})
    if (const auto& place = source.places[side]; place.mover != none && !movers_.free(place.mover))
      apply_wrench(place, *terms.bodies[side], wrench_at(*terms.bodies[side], terms.contact->point, side == 0 ? impulse : -impulse));
}

/// For the engine, which gives trees their velocities; those of free bodies are known.
void IterativeSolver::apply_wrench(Movers::Place place, BodyNode& body, const Eigen::Vector6d& wrench) const
{
  if (movers_.free(place.mover))
    return;
  body.*engine::BodyMembers::constraint_impulse += wrench;
  movers_.skeleton(place).setImpulseApplied(true);
}

} // namespace pydart2
