#include "dynamics/tree_rows.hpp"

#include <algorithm>

namespace pydart2 {

namespace {

constexpr int none = TreeImpulses::none;
using Lanes = TreeRows::Lanes;

/// spatial::to_parent() for wrenches in rows, added to `sum`.
[[gnu::always_inline]] inline void add_to_parent(const Eigen::Isometry3d& T, const Lanes& wrenches, Lanes& sum)
{
  const Eigen::Matrix3d R = T.linear().transpose();
  const auto& p = T.translation();
  const Eigen::Matrix<double, TreeRows::lanes, 3> force = wrenches.rightCols<3>() * R;
  sum.leftCols<3>().noalias() += wrenches.leftCols<3>() * R;
  sum.col(0) += p[1] * force.col(2) - p[2] * force.col(1);
  sum.col(1) += p[2] * force.col(0) - p[0] * force.col(2);
  sum.col(2) += p[0] * force.col(1) - p[1] * force.col(0);
  sum.rightCols<3>() += force;
}

} // namespace

void TreeRows::prepare()
{
  states_.resize(static_cast<std::size_t>(trees_.size()));
  sizes_.clear();
  for (int body = 0; body < trees_.size(); ++body) {
    const auto tree = static_cast<std::size_t>(trees_.tree(body));
    sizes_.resize(std::max(sizes_.size(), tree + 1), 0);
    state(body).start = sizes_[tree];
    sizes_[tree] += trees_.dofs(body);
  }
}

void TreeRows::write(int body1, int body2, const std::array<Rows, 2>& rows)
{
  // Bodies have higher numbers than their parents: the higher one of two paths' ends is never above the other.
  for (int a = body1, b = body2; a != none || b != none;) {
    const int body = std::max(a, b), parent = trees_.parent(body);
    send_up(body, rows[a == body ? 0 : 1]);
    if (a == body)
      a = parent;
    if (b == body)
      b = parent;
  }
}

[[gnu::flatten]] void TreeRows::send_up(int body, const Rows& rows)
{
  auto& its = state(body);
  const int parent = trees_.parent(body);
  trees_.visit_joint(body, [&](const auto& joint) {
    constexpr int dofs = std::decay_t<decltype(joint)>::dofs;
    if constexpr (dofs > 0) {
      using Impulses = Eigen::Matrix<double, lanes, dofs>;
      Impulses tau = its.impulse.leftCols<dofs>();
      tau.noalias() -= its.bias * joint.J;
      its.impulse.leftCols<dofs>().setZero();
      if (parent != none)
        its.bias.noalias() += tau * joint.K.transpose();
      const Impulses tau_P = tau * joint.P.transpose();
      for (int row = 0; row < rows.count; ++row)
        for (int dof = 0; dof < dofs; ++dof) {
          rows.J[row * rows.length + its.start + dof] = tau(row, dof);
          rows.Y[row * rows.length + its.start + dof] = tau_P(row, dof);
        }
    }
  });
  if (parent != none)
    add_to_parent(trees_.transform(body), its.bias, state(parent).bias);
  its.bias.setZero();
}

} // namespace pydart2
