#include "contact/constraint_matrix.hpp"

#include <algorithm>
#include <dart/dynamics/PointMass.hpp>

#include "engine/tree_members.hpp"

namespace pydart2 {

namespace {

using dart::constraint::ConstrainedGroup;
using dart::constraint::ConstraintBase;
using dart::dynamics::BodyNode;
using dart::dynamics::PointMass;
using dart::dynamics::SkeletonPtr;
using engine::Rows;
using engine::SumOrder;

constexpr int none = TreeImpulses::none;
constexpr int orders = 3; // of engine::SumOrder

/// The sums of p(0) to p(5), arrays with an element for each row.
template <class Products>
void sum(SumOrder order, const Products& p, double* values, int size)
{
  Eigen::Map<Eigen::ArrayXd> out(values, size);
  switch (order) {
    case SumOrder::lanes:
      out = (p(0) + (p(2) + p(4))) + (p(1) + (p(3) + p(5)));
      break;
    case SumOrder::halves:
      out = (p(0) + (p(1) + p(2))) + (p(3) + (p(4) + p(5)));
      break;
    case SumOrder::sequence:
      out = ((((p(0) + p(1)) + p(2)) + p(3)) + p(4)) + p(5);
      break;
  }
}

} // namespace

void ConstraintMatrix::clear()
{
  items_.clear();
  trees_.clear();
  joint_readings_.clear();
  points_.clear();
  point_readings_.clear();
  point_numbers_.clear();
  foreign_.clear();
}

engine::Rows& ConstraintMatrix::add_rows(int count)
{
  const int begin = items_.empty() ? 0 : items_.back().end;
  auto& item = items_.emplace_back();
  item.begin = begin;
  item.end = begin + count;
  return item.rows;
}

void ConstraintMatrix::read(ConstrainedGroup& group, const std::vector<SkeletonPtr>& skeletons)
{
  clear();
  for (std::size_t i = 0; i < group.getNumConstraints(); ++i) {
    const auto constraint = group.getConstraint(i);
    engine::read_rows(*constraint, add_rows(static_cast<int>(constraint->getDimension())));
    if (items_.back().rows.kind == Rows::Kind::unknown) {
      items_.back().by_engine = true;
      find_foreign(*constraint, skeletons);
    }
  }
  settle();
}

void ConstraintMatrix::settle()
{
  for (auto& item : items_)
    if (item.rows.kind == Rows::Kind::joint)
      add_joint(item);
    else if (item.rows.kind == Rows::Kind::bodies)
      for (const std::size_t side : {0, 1})
        add_side(item, side);
  trees_.prepare();
}

/// A constraint acts on the skeletons that it marks when it is excited.
void ConstraintMatrix::find_foreign(ConstraintBase& constraint, const std::vector<SkeletonPtr>& all)
{
  constraint.excite();
  for (const auto& skeleton : all)
    if (skeleton->isImpulseApplied())
      foreign_.push_back(skeleton.get());
  constraint.unexcite();
}

bool ConstraintMatrix::is_foreign(const BodyNode& body) const
{
  return std::find(foreign_.begin(), foreign_.end(), body.getSkeleton().get()) != foreign_.end();
}

void ConstraintMatrix::add_side(Item& item, std::size_t side)
{
  const auto& rows = item.rows.bodies;
  auto* body = rows.bodies[side];
  const auto* point = rows.points[side];
  if (point == nullptr) {
    item.bodies[side] = body == nullptr ? none : add(body, item);
  } else if (body->isReactive()) {
    if (is_foreign(*body))
      item.by_engine = true;
    else
      item.points[side] = add_point(*point, item, rows.directions[side]);
  }
}

int ConstraintMatrix::add_point(const PointMass& mass, const Item& item, const engine::Directions& directions)
{
  const auto [number, is_new] = point_numbers_.try_emplace(&mass, static_cast<int>(points_.size()));
  if (is_new)
    points_.push_back({mass.getPsi(), none, none});
  auto& point = points_[static_cast<std::size_t>(number->second)];
  for (int row = item.begin; row < item.end; ++row) {
    const int reading = static_cast<int>(point_readings_.size());
    point_readings_.push_back({row, none, directions.col(row - item.begin).tail<3>()});
    (point.last == none ? point.first : point_readings_[static_cast<std::size_t>(point.last)].next) = reading;
    point.last = reading;
  }
  return number->second;
}

/// Number of a body that the rows of `item` act on, `none` if no impulse moves it or if it is the engine's affair.
int ConstraintMatrix::add(BodyNode* body, Item& item)
{
  int number = trees_.find(body);
  if (number == none) {
    if (item.rows.kind == Rows::Kind::bodies && !body->isReactive())
      return none;
    if (is_foreign(*body)) {
      item.by_engine = true;
      return none;
    }
    number = trees_.add(*body);
  }
  trees_.need(number, item.end - 1);
  return number;
}

void ConstraintMatrix::add_joint(Item& item)
{
  const auto& joint = item.rows.joint;
  const int body = item.bodies[0] = add(joint.joint->getChildBodyNode(), item);
  int row = item.begin;
  for (int dof = 0; body != none && dof < static_cast<int>(joint.active.size()); ++dof)
    if (joint.active[dof])
      joint_readings_.push_back({row++, body, dof});
}

void ConstraintMatrix::gather_readings()
{
  const auto each = [this](const auto& visit) {
    for (const auto& item : items_)
      for (const int side : {0, 1})
        if (item.rows.kind == Rows::Kind::bodies && item.bodies[side] != none)
          for (int i = 0; i < item.end - item.begin; ++i)
            visit(
                orders * item.bodies[side] + int(item.rows.bodies.orders[i]),
                item.begin + i,
                item.rows.bodies.directions[side].col(i));
  };
  ends_.assign(orders * trees_.size() + 1, 0);
  each([this](int key, int, const auto&) { ++ends_[key + 1]; });
  for (std::size_t key = 1; key < ends_.size(); ++key)
    ends_[key] += ends_[key - 1];
  starts_ = ends_;
  const int columns = ends_.back();
  if (columns > directions_.cols()) {
    directions_.resize(6, columns);
    direction_rows_.resize(columns);
    values_.resize(columns);
  }
  each([this](int key, int row, const auto& direction) {
    const int column = ends_[key]++;
    directions_.col(column) = direction;
    direction_rows_[column] = row;
  });
}

void ConstraintMatrix::fill(ConstrainedGroup* group, double time_step, Matrix& A)
{
  gather_readings();
  for (const auto& item : items_)
    A.block(item.begin, item.begin, item.end - item.begin, A.cols() - item.begin).setZero();
  for (std::size_t i = 0; i < items_.size(); ++i)
    if (items_[i].by_engine)
      fill_rows_by_engine(*group, i, A);
    else
      fill_rows(items_[i], time_step, A);
  // Below the diagonal as above it, but for the square of each constraint, which is full.
  for (const auto& item : items_)
    for (int row = item.begin; row < item.end; ++row)
      for (int column = 0; column < item.begin; ++column)
        A(row, column) = A(column, row);
}

void ConstraintMatrix::fill_rows(const Item& item, double time_step, Matrix& A)
{
  const auto [body1, body2] = item.bodies;
  for (int row = item.begin; row < item.end; ++row) {
    push(item, row);
    trees_.solve(body1, body2, item.begin);
    double* out = A.row(row).data();
    if (body1 != none)
      read_tree(trees_.tree(body1), item.begin, out);
    if (body2 != none && (body1 == none || trees_.tree(body1) != trees_.tree(body2)))
      read_tree(trees_.tree(body2), item.begin, out);
    for (const std::size_t side : {0, 1})
      if (item.points[side] != none)
        read_point(item.points[side], item, item.rows.bodies.directions[side].col(row - item.begin).tail<3>(), out);

    out[row] += out[row] * item.rows.force_mixing;
    if (item.rows.kind == Rows::Kind::bodies && row > item.begin && row <= item.begin + 2)
      out[row] += item.rows.bodies.slip[row - item.begin - 1] / time_step;
  }
}

void ConstraintMatrix::push(const Item& item, int row)
{
  const int index = row - item.begin;
  if (item.rows.kind == Rows::Kind::bodies) {
    for (const int side : {0, 1})
      if (item.bodies[side] != none)
        trees_.push(item.bodies[side], item.rows.bodies.directions[side].col(index));
  } else {
    const auto& active = item.rows.joint.active;
    int dof = 0;
    for (int before = index; !active[dof] || before-- > 0;)
      ++dof;
    trees_.push_joint(item.bodies[0], dof);
  }
}

void ConstraintMatrix::read_tree(int tree, int first_row, double* out)
{
  for (int body = trees_.first(tree); body != none; body = trees_.next(body))
    if (trees_.last_row(body) >= first_row)
      read_body(body, first_row, out);
  for (const auto& reading : joint_readings_)
    if (reading.row >= first_row && trees_.tree(reading.body) == tree)
      out[reading.row] += trees_.joint_velocity_change(reading.body, reading.dof);
}

void ConstraintMatrix::read_body(int body, int first_row, double* out)
{
  const auto& velocity = trees_.velocity_change(body);
  for (int order = 0; order < orders; ++order) {
    const int key = orders * body + order;
    int& start = starts_[key];
    while (start < ends_[key] && direction_rows_[start] < first_row)
      ++start;
    const int size = ends_[key] - start;
    if (size == 0)
      continue;
    const auto columns = directions_.middleCols(start, size).array();
    const auto product = [&](int i) { return columns.row(i).transpose() * velocity[i]; };
    sum(SumOrder(order), product, values_.data(), size);
    for (int i = 0; i < size; ++i)
      out[direction_rows_[start + i]] += values_[i];
  }
}

/// What rows read of a point that gets an impulse of a row of `item`.
void ConstraintMatrix::read_point(int number, const Item& item, const Eigen::Vector3d& impulse, double* out) const
{
  const auto& point = points_[static_cast<std::size_t>(number)];
  const Eigen::Vector3d change = point.inverse_mass * impulse;
  for (int i = point.first; i != none;) {
    const auto& reading = point_readings_[static_cast<std::size_t>(i)];
    if (reading.row >= item.begin)
      out[reading.row] += reading.direction.dot(change);
    i = reading.next;
  }
}

void ConstraintMatrix::apply(ConstrainedGroup& group, double time_step, Eigen::VectorXd& impulses) const
{
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const auto& item = items_[i];
    const auto constraint = group.getConstraint(i);
    double* impulse = impulses.data() + item.begin;
    if (item.by_engine || !engine::store_force(*constraint, impulse, time_step)) {
      constraint->applyImpulse(impulse);
      constraint->excite();
      continue;
    }
    apply(i, impulse);
  }
}

/// A contact of the engine asks ten times whether its bodies can move.
void ConstraintMatrix::apply(std::size_t constraint, const double* impulses) const
{
  const auto& item = items_[constraint];
  const auto& rows = item.rows.bodies;
  for (const int side : {0, 1}) {
    if (item.bodies[side] == none)
      continue;
    auto& impulse = rows.bodies[side]->*engine::BodyMembers::constraint_impulse;
    Eigen::Vector6d sum = impulse;
    for (int row = 0; row < item.end - item.begin; ++row)
      sum += rows.directions[side].col(row) * impulses[row];
    impulse = sum;
    trees_.skeleton(item.bodies[side]).setImpulseApplied(true);
  }
}

void ConstraintMatrix::fill_rows_by_engine(ConstrainedGroup& group, std::size_t index, Matrix& A) const
{
  const auto& item = items_[index];
  auto& constraint = *group.getConstraint(index);
  constraint.excite();
  for (int row = item.begin; row < item.end; ++row) {
    constraint.applyUnitImpulse(row - item.begin);
    double* out = A.row(row).data();
    constraint.getVelocityChange(out + item.begin, true);
    for (std::size_t other = index + 1; other < items_.size(); ++other)
      group.getConstraint(other)->getVelocityChange(out + items_[other].begin, false);
  }
  constraint.unexcite();
}

} // namespace pydart2
