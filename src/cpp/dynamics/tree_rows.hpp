#pragma once

#include <array>
#include <dart/math/Geometry.hpp>
#include <vector>

#include "dynamics/tree_impulses.hpp"

namespace pydart2 {

/// Rows for solvers that ask no more of a tree than A = J M^-1 J', from the way up of TreeImpulses alone: with the total
/// generalised impulses tau at the joints,
///   A = tau P tau',
/// since the velocity change at a joint is P tau if what it hangs on is held (Featherstone's algorithm as a factorisation of
/// M^-1: Rodriguez, Jain and Kreutz-Delgado, Int. J. Robotics Research 10, 1991). So tau stands for J, tau P for M^-1 J', and
/// a tree's velocities are those of joints on what is held, `held`, until joint_changes() makes of them what they are.
class TreeRows
{
public:
  static constexpr int lanes = 4;
  using Vector6 = TreeImpulses::Vector6;
  /// Impulses, each a row, so that a column of them fits the processor's registers.
  using Lanes = Eigen::Matrix<double, lanes, 6>;

  /// `count` rows in the place of J and M^-1 J', each of `length` numbers.
  struct Rows
  {
    double *J = nullptr, *Y = nullptr;
    int count = 0, length = 0;
  };

  explicit TreeRows(const TreeImpulses& trees) : trees_(trees) {}
  TreeRows(const TreeRows&) = delete;

  /// Once the trees are prepared.
  void prepare();

  /// How many degrees of freedom a tree has, and how many up to those of a body's joint: no others are in its rows.
  int size(int tree) const { return sizes_[static_cast<std::size_t>(tree)]; }
  int end(int body) const { return states_[static_cast<std::size_t>(body)].start + trees_.dofs(body); }

  /// Impulses for the next write(): wrenches on a body in its frame, or one at a joint's degree of freedom.
  void push(int body, const Lanes& wrenches) { state(body).bias = -wrenches; }
  void push_joint(int body, int dof, int lane) { state(body).impulse(lane, dof) = 1.0; }

  /// Writes the rows of what was pushed at body1 and body2 (or `none`), and forgets it. Those of one tree are in one
  /// place.
  void write(int body1, int body2, const std::array<Rows, 2>& rows);

  /// Calls `give(its velocities, their change)` for each joint of a tree that impulses move.
  template <class Give>
  void joint_changes(int tree, const double* held, const Give& give);

private:
  struct State
  {
    int start = 0; ///< Of the joint's degrees of freedom among those of the tree.
    Lanes bias = Lanes::Zero(), impulse = Lanes::Zero();
    Vector6 change;
  };

  State& state(int body) { return states_[static_cast<std::size_t>(body)]; }
  void send_up(int body, const Rows& rows);

  const TreeImpulses& trees_;
  std::vector<State> states_;
  std::vector<int> sizes_;
};

template <class Give>
void TreeRows::joint_changes(int tree, const double* held, const Give& give)
{
  for (int body = trees_.first(tree); body != TreeImpulses::none; body = trees_.next(body)) {
    auto& its = state(body);
    if (const int parent = trees_.parent(body); parent == TreeImpulses::none)
      its.change.setZero();
    else
      its.change = dart::math::AdInvT(trees_.transform(body), state(parent).change);
    trees_.visit_joint(body, [&](const auto& joint) {
      constexpr int dofs = std::decay_t<decltype(joint)>::dofs;
      if constexpr (dofs > 0) {
        using Vector = Eigen::Matrix<double, dofs, 1>;
        const Vector change = Eigen::Map<const Vector>(held + its.start) - joint.P * (joint.G * its.change);
        its.change += joint.J * change;
        give(trees_.velocities(body), change);
      }
    });
  }
}

} // namespace pydart2
