#pragma once

#include <Eigen/Core>
#include <array>
#include <dart/constraint/ConstrainedGroup.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <unordered_map>
#include <vector>

#include "dynamics/tree_impulses.hpp"
#include "engine/engine_access.hpp"

namespace pydart2 {

/// The matrix A of the linear complementarity problem of a group of constraints, w = A x - b: element (i, j) is the
/// change of the velocity that row j reads by a unit impulse of row i, A = N M^-1 N' with the rows' directions N and
/// the mass matrix M. Every element is bitwise the one that dart::constraint::BoxedLcpConstraintSolver computes.
///
/// DART sends each unit impulse through the whole skeleton and lets every constraint read its rows. Here it travels
/// only through bodies that bear a row and their ancestors (TreeImpulses), and each body reads the rows that it bears
/// at once. A point of a soft body answers to the impulses at itself, with its own mass, and to no others: what its body
/// moves by it takes back. Constraints that this does not know, and those on the same skeletons as these, take DART's way.
class ConstraintMatrix
{
public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// Reads the rows of a group; `skeletons` are all that its constraints may act on.
  void read(dart::constraint::ConstrainedGroup& group, const std::vector<dart::dynamics::SkeletonPtr>& skeletons);

  /// The same of constraints of known kinds: the rows of one after the other are to be filled in, then settled.
  void clear();
  engine::Rows& add_rows(int count);
  void settle();

  /// Fills A, square and as large as the group that was read, which may be null if all kinds are known. `time_step` is the
  /// one of the contacts.
  void fill(dart::constraint::ConstrainedGroup* group, double time_step, Matrix& A);

  /// Applies the impulses of all rows to the bodies, as each constraint would.
  void apply(dart::constraint::ConstrainedGroup& group, double time_step, Eigen::VectorXd& impulses) const;

  /// Applies those of one constraint of two bodies.
  void apply(std::size_t constraint, const double* impulses) const;

private:
  using Skeleton = dart::dynamics::Skeleton;

  /// A constraint of the group, and the numbers in trees_ of the bodies that its rows act on: the child body of a
  /// joint, or two bodies; `none` for one that is missing or that no impulse moves.
  struct Item
  {
    engine::Rows rows;
    int begin = 0, end = 0; ///< Its rows.
    std::array<int, 2> bodies{TreeImpulses::none, TreeImpulses::none};
    std::array<int, 2> points{TreeImpulses::none, TreeImpulses::none}; ///< Of soft bodies, in the bodies' place.
    bool by_engine = false; ///< Its rows take DART's way.
  };

  /// A row that reads the velocity change of a degree of freedom.
  struct JointReading
  {
    int row, body, dof;
  };

  /// A point of a soft body, and the first of its readings in the list and the last.
  struct Point
  {
    double inverse_mass;
    int first, last;
  };

  /// A row that reads the velocity change of a point, and the next one of this point.
  struct PointReading
  {
    int row, next;
    Eigen::Vector3d direction;
  };

  void find_foreign(dart::constraint::ConstraintBase& constraint, const std::vector<dart::dynamics::SkeletonPtr>& all);
  bool is_foreign(const dart::dynamics::BodyNode& body) const;
  void add_side(Item& item, std::size_t side);
  int add(dart::dynamics::BodyNode* body, Item& item);
  int add_point(const dart::dynamics::PointMass& point, const Item& item, const engine::Directions& directions);
  void add_joint(Item& item);
  void gather_readings();

  void fill_rows(const Item& item, double time_step, Matrix& A);
  void push(const Item& item, int row);
  void read_tree(int tree, int first_row, double* out);
  void read_body(int body, int first_row, double* out);
  void read_point(int point, const Item& item, const Eigen::Vector3d& impulse, double* out) const;
  void fill_rows_by_engine(dart::constraint::ConstrainedGroup& group, std::size_t index, Matrix& A) const;

  TreeImpulses trees_;
  std::vector<Item> items_;
  std::vector<const Skeleton*> foreign_; ///< Skeletons that constraints of unknown kinds act on.
  std::vector<JointReading> joint_readings_;
  std::vector<Point> points_;
  std::vector<PointReading> point_readings_;
  std::unordered_map<const dart::dynamics::PointMass*, int> point_numbers_;

  // Directions of all rows at bodies, a column each, component by component in memory; sorted by body, order of
  // summation and row. A body's columns of one order run from starts_ to ends_; starts_ moves past rows that are done.
  Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> directions_;
  std::vector<int> direction_rows_, starts_, ends_;
  Eigen::ArrayXd values_;
};

} // namespace pydart2
