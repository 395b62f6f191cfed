#pragma once

#include <array>
#include <dart/dynamics/FreeJoint.hpp>
#include <deque>
#include <unordered_map>
#include <vector>

#include "dynamics/free_bodies.hpp"
#include "dynamics/tree_impulses.hpp"

namespace pydart2 {

/// What impulses move: rigid bodies that are free and alone, and trees of articulated bodies. A free body's velocity is
/// that of the world at its centre of mass, angular before linear, and needs no tree; a tree's is that of its joints.
class Movers
{
public:
  static constexpr int none = TreeImpulses::none;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// A body: what it moves with, and its number in the trees.
  struct Place
  {
    int mover = none, body = none;
  };

  /// For a step; `free` bodies are in an array, if not null.
  void begin(FreeBodies* free);

  /// Where a body is, with no mover if no impulse moves it; `place` among the free bodies, if it is one.
  Place add(dart::dynamics::BodyNode* body, int place = none);

  /// The same of a body whose joint has rows of its own, and so is part of a tree; before all that add() adds.
  Place add_joint(dart::dynamics::BodyNode& body);

  /// Reads the engine's state, once all bodies are there.
  void prepare();

  int size() const { return static_cast<int>(movers_.size()); }
  int dofs(int mover) const { return at(mover).size; }

  /// Where a mover's velocity begins in that of all.
  int start(int mover) const { return at(mover).start; }
  void set_start(int mover, int start) { at(mover).start = start; }

  bool free(int mover) const { return at(mover).tree == none; }

  /// Of an impulse at a point of a free body, in the world's frame: what it is at the centre of mass, and what velocity
  /// it gives.
  void point_row(int mover, const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double* J, double* Y) const;

  /// Velocity of a free body along it.
  double speed(int mover, const double* J) const;

  /// The same of wrenches on one or two bodies, in their frames: a row of the two movers, or of the one that both are of.
  void wrench_row(const std::array<Place, 2>& places, const std::array<Vector6, 2>& wrenches, std::array<double*, 2> J, std::array<double*, 2> Y);

  /// Of a unit impulse at a joint's degree of freedom.
  void joint_row(Place place, int dof, double* J, double* Y);

  /// Takes from the change `velocities` what would leave free bodies that impulses move with a speed of no more than
  /// `noise`, and as much from those that are slower than `most`.
  void calm(Eigen::VectorXd& velocities, double noise, double most) const;

  /// Gives free bodies their share of the change `velocities` of all: those in the array, or the joints of the others.
  void move_free_in_array(const Eigen::VectorXd& velocities);
  void move_free(const Eigen::VectorXd& velocities, double time_step) const;

  /// Gives free bodies in the array what is to correct their positions.
  void correct_free(const Eigen::VectorXd& velocities);

  /// Calls `give(joint, change of its velocities)` for each joint of what moves, but for the bodies in the array.
  template <class Give>
  void each_joint(const Eigen::VectorXd& velocities, const Give& give) const;

private:
  struct Mover
  {
    int tree = none; ///< None: a free body.
    int start = 0, size = 6;
    FreeBodies::Body* body = nullptr;
    bool in_array = false;
  };

  Mover& at(int mover) { return movers_[static_cast<std::size_t>(mover)]; }
  const Mover& at(int mover) const { return movers_[static_cast<std::size_t>(mover)]; }
  Place add_to_trees(dart::dynamics::BodyNode& body);
  Vector6 joint_change(const Mover& mover, const Eigen::VectorXd& velocities) const;
  void answer_of_tree(int tree, double* Y) const;

  std::vector<Mover> movers_;
  FreeBodies* free_ = nullptr;
  std::vector<int> of_free_; ///< The mover of each body in the array.
  std::deque<FreeBodies::Body> read_; ///< Other free bodies.
  std::unordered_map<const dart::dynamics::BodyNode*, Place> places_;
  TreeImpulses trees_;
  std::vector<int> of_tree_; ///< Its mover.
  std::vector<int> starts_; ///< Of each body's joint in its tree's velocity.
};

template <class Give>
void Movers::each_joint(const Eigen::VectorXd& velocities, const Give& give) const
{
  for (const auto& mover : movers_) {
    if (velocities.segment(mover.start, mover.size).isZero(0.0))
      continue;
    if (mover.in_array)
      continue;
    if (mover.tree == none) {
      give(*static_cast<dart::dynamics::Joint*>(mover.body->joint), Eigen::VectorXd(joint_change(mover, velocities)));
      continue;
    }
    for (int body = trees_.first(mover.tree); body != none; body = trees_.next(body))
      if (const int dofs = trees_.dofs(body); dofs > 0)
        give(
            *trees_.node(body).getParentJoint(),
            Eigen::VectorXd(velocities.segment(mover.start + starts_[static_cast<std::size_t>(body)], dofs)));
  }
}

} // namespace pydart2
