#pragma once

#include <Eigen/Core>
#include <array>
#include <dart/constraint/ConstrainedGroup.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <vector>

#include "contact/contact_memory.hpp"
#include "dynamics/tree_impulses.hpp"
#include "engine/engine_access.hpp"

namespace pydart2 {

/// Settings of the iterative solver.
struct IterativeOptions
{
  enum class Friction {
    pyramid, ///< Each tangent within mu times the normal impulse.
    cone,    ///< Both together.
    engine   ///< Each tangent within mu times what the normal impulse is without friction.
  };

  int iterations = 50;         ///< Sweeps over all rows, at most.
  double tolerance = 1e-6;     ///< m/s, rad/s: the residual at which the sweeps end.
  Friction friction = Friction::pyramid;
  bool split = true;           ///< Depth is taken away by moving bodies, not by velocities (else as the engine does).
  double error_reduction = 0.2; ///< The part of the depth that goes in a step.
  double allowance = 1e-4;      ///< m: the depth that stays.
  double correction_speed = 1.0; ///< m/s: at most this fast.
};

/// Iterations, tolerance, friction, split, error reduction, allowance, correction speed.
Eigen::VectorXd numbers_of(const IterativeOptions& options);

/// ValueError for numbers that cannot be.
IterativeOptions options_of(const Eigen::VectorXd& numbers);

/// The rows of a group: A x = b + w as in BoxedLcp, A not given.
struct RowTerms
{
  const Eigen::VectorXd &lo, &hi;
  const Eigen::VectorXi& findex;
  Eigen::VectorXd& b;
};

/// Block Gauss-Seidel with projection (Moreau and Jean, as in Acary and Brogliato, Numerical Methods for Nonsmooth
/// Dynamical Systems, 2008, chapter 13): each constraint's rows are solved as a block, one after the other, and change
/// the velocities of the joints that they move at once. A row is a vector over the joints of its trees, and its column of M^-1 J' another, so a sweep costs
/// what the rows cost; there is no matrix over a group. After a sweep the impulses go on in the direction in which the
/// sweeps take them, as in conjugate gradients (Silcowitz, Niebe and Erleben, The Visual Computer 26, 2010).
class IterativeSolver
{
public:
  IterativeOptions options;

  void begin_step(const std::vector<dart::dynamics::SkeletonPtr>& skeletons);

  /// False, and nothing is done, if there are constraints or bodies in the group that it does not know.
  bool read(dart::constraint::ConstrainedGroup& group);

  /// The impulses of a group that was read, which are remembered for the next step.
  void solve(dart::constraint::ConstrainedGroup& group, RowTerms terms, double time_step, bool warm, Eigen::VectorXd& x);

  /// Hands the impulses to the bodies and the forces to the contacts.
  void apply(dart::constraint::ConstrainedGroup& group, double time_step, Eigen::VectorXd& x) const;

  /// Adds to the velocities of joints what takes depth away, for the time of an integration of positions; and takes it
  /// off, bit for bit.
  void add_corrections();
  void take_off_corrections();

  /// Of the last step: of all groups the largest. The residual of a row is what a step of projection changes of it,
  /// W |x - P(x - w / W)| with its diagonal element W, in m/s or rad/s.
  int iterations_used() const { return iterations_used_; }
  double residual() const { return residual_; }

  ContactMemory memory;

private:
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;

  /// A row's part at one tree: at velocities_[start], `size` of them.
  struct Part
  {
    int start = 0, size = 0;
  };
  struct Block
  {
    engine::Rows rows;
    std::array<int, 2> bodies{TreeImpulses::none, TreeImpulses::none};
    std::array<Part, 2> parts;
    int begin = 0, size = 0; ///< Rows.
    std::size_t data = 0;    ///< In J_ and Y_: row after row, part after part.
    bool contact = false;
    double depth = 0.0;
    Small W, inverse; ///< Its square of A.
    SmallVector mixing; ///< The part of A's diagonal that is not M^-1.
    bool movable = false;
  };
  struct Correction
  {
    dart::dynamics::Joint* joint;
    Eigen::VectorXd velocity, saved;
  };

  int add(dart::dynamics::BodyNode* body, bool joint, bool& known);
  void place_joints();
  void fill(Block& block, double time_step);
  void push(const Block& block, int row);
  void separate_corrections(RowTerms& terms, double time_step);
  double read_velocity(const Block& block, int row) const;
  void change_velocity(const Block& block, int row, double impulse);
  void sweep_until_done(const RowTerms& terms, Eigen::VectorXd& x);
  double solve_block(const Block& block, const RowTerms& terms, Eigen::VectorXd& x);
  void project(const Block& block, const RowTerms& terms, SmallVector& x) const;
  void bound(const Block& block, int row, const RowTerms& terms, const SmallVector& x, double& lo, double& hi) const;
  double measure(const RowTerms& terms, const Eigen::VectorXd& x) const;
  void find_corrections(const RowTerms& terms, double time_step);

  TreeImpulses trees_;
  std::vector<Block> blocks_;
  std::vector<int> starts_;      ///< Of each body's joint in velocities_.
  std::vector<Part> tree_parts_; ///< Of each tree.
  std::vector<double> J_, Y_;
  Eigen::VectorXd velocities_;   ///< Changes by the impulses.
  Eigen::VectorXd frozen_;       ///< Normal impulses that bound friction; empty: those of the moment.
  std::vector<Correction> corrections_;
  int iterations_used_ = 0;
  double residual_ = 0.0;
};

} // namespace pydart2
