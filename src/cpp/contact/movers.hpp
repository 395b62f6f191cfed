#pragma once

#include <array>
#include <dart/dynamics/FreeJoint.hpp>
#include <deque>
#include <vector>

#include "base/lookup.hpp"
#include "dynamics/free_bodies.hpp"
#include "dynamics/tree_rows.hpp"

namespace pydart2 {

/// What impulses move: rigid bodies that are free and alone, and trees of articulated bodies. A free body's velocity is
/// that of the world at its centre of mass, angular before linear, and needs no tree; a tree's is that of its joints on what is held
/// (TreeRows).
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

  /// How many columns the rows of a body have: they move no joint whose number is higher than its own.
  int columns(const Place& place) const { return free(place.mover) ? 6 : tree_rows_.end(place.body); }

  /// Where a mover's velocity begins in that of all.
  int start(int mover) const { return at(mover).start; }
  void set_start(int mover, int start) { at(mover).start = start; }

  bool free(int mover) const { return at(mover).tree == none; }

  /// Of a body in a tree.
  dart::dynamics::Skeleton& skeleton(const Place& place) const { return trees_.skeleton(place.body); }

  /// Of an impulse at a point of a free body, in the world's frame: what it is at the centre of mass, and what velocity
  /// it gives.
  void point_row(int mover, const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double* J, double* Y) const;

  /// Velocity of a free body along it.
  double speed(int mover, const double* J) const;

  /// Where rows are written, one after the other: of two movers, or of the one that both bodies are of.
  using Rows = TreeRows::Rows;

  /// The same of wrenches on one or two bodies, in their frames.
  void wrench_rows(
      const std::array<Place, 2>& places, const std::array<TreeRows::Lanes, 2>& wrenches, const std::array<Rows, 2>& rows);

  /// Of unit impulses at a joint's degrees of freedom.
  void joint_rows(Place place, const int* dofs, const Rows& rows);

  /// Takes from the change `velocities` what would leave free bodies that impulses move with a speed of no more than
  /// `noise`, and as much from those that are slower than `most`.
  void calm(Eigen::VectorXd& velocities, double noise, double most) const;

  /// Gives free bodies their share of the change `velocities` of all: those in the array, or the joints of the others.
  void move_free_in_array(const Eigen::VectorXd& velocities);
  void move_free(const Eigen::VectorXd& velocities, double time_step) const;

  /// Gives free bodies in the array what is to correct their positions.
  void correct_free(const Eigen::VectorXd& velocities);

  /// Calls `give(its velocities, their change)` for each joint of what moves, but for the bodies in the array.
  template <class Give>
  void each_joint(const Eigen::VectorXd& velocities, const Give& give);

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
  static double* velocities_of(dart::dynamics::FreeJoint& joint);

  std::vector<Mover> movers_;
  FreeBodies* free_ = nullptr;
  std::vector<int> of_free_; ///< The mover of each body in the array.
  std::deque<FreeBodies::Body> read_; ///< Other free bodies.
  Lookup<dart::dynamics::BodyNode, Place> places_;
  TreeImpulses trees_;
  TreeRows tree_rows_{trees_};
  std::vector<int> of_tree_; ///< Its mover.
};

template <class Give>
void Movers::each_joint(const Eigen::VectorXd& velocities, const Give& give)
{
  for (const auto& mover : movers_) {
    if (mover.in_array || velocities.segment(mover.start, mover.size).isZero(0.0))
      continue;
    if (mover.tree == none)
      give(velocities_of(*mover.body->joint), joint_change(mover, velocities));
    else
      tree_rows_.joint_changes(mover.tree, velocities.data() + mover.start, give);
  }
}

} // namespace pydart2
