#pragma once

#include <Eigen/Geometry>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <variant>
#include <vector>

#include "base/lookup.hpp"

namespace pydart2 {

/// Velocity changes of articulated bodies by impulses: the impulse form of Featherstone's articulated-body algorithm
/// (Rigid Body Dynamics Algorithms, chapter 7), restricted to the bodies that matter and to their ancestors.
///
/// With spatial vectors as in DART (angular before linear, in the body's frame), for each body
///   T            its transform relative to its parent,
///   J            the Jacobian of its joint,
///   I            its articulated inertia, without implicit damping and springs,
///   P = (J' I J)^-1,
///   K = I J P,   G = J' I.
/// An impulse f at a body and a generalised impulse c at its joint travel up to the root, b = -f at first,
///   tau = c - J' b,   b_parent += dAdInv(T) (b + K tau),
/// and the velocity changes dV and dq come down again,
///   a = AdInv(T) dV_parent,   dq = P (tau - G a),   dV = a + J dq.
/// A joint whose motion is prescribed, or that has none, passes b up and a down as they are.
///
/// K and G are the products that DART forms in each of these steps, from left to right; formed once and written with
/// the same Eigen types they leave every bit of the results as DART has it.
class TreeImpulses
{
public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  static constexpr int none = -1;

  /// Forgets all bodies.
  void clear();

  /// Number of a body, `none` if it is not there.
  int find(const dart::dynamics::BodyNode* body) const
  {
    const int* number = numbers_.find(body);
    return number == nullptr ? none : *number;
  }

  /// Number of a body, which is added with its ancestors if it is new. Numbers grow from the root to the leaves.
  int add(dart::dynamics::BodyNode& body);

  /// Velocity changes of a tree are wanted at `body` for the impulses of rows up to `row`; rows come in ascending
  /// order.
  void need(int body, int row) { bodies_[body].last_row = row; }

  /// Reads the engine's state, once all bodies are there.
  void prepare();

  int size() const { return static_cast<int>(bodies_.size()); }
  int tree(int body) const { return bodies_[body].tree; }

  /// The first body of a tree, and the next one; `none` after the last.
  int first(int tree) const { return trees_[tree].first; }
  int next(int body) const { return bodies_[body].next; }
  int last_row(int body) const { return bodies_[body].last_row; }

  /// An impulse for the next solve(): a wrench on a body in its frame, or a unit impulse at a joint's degree of
  /// freedom.
  void push(int body, const Vector6& impulse) { bodies_[body].bias = -impulse; }
  void push_joint(int body, int dof);

  /// Velocity changes of the trees of body1 and body2 (or `none`), which the impulses act on, at all bodies that are
  /// needed from `row` on. The impulses are used up.
  void solve(int body1, int body2, int row);

  const Vector6& velocity_change(int body) const { return bodies_[body].change; }
  double joint_velocity_change(int body, int dof) const;

  dart::dynamics::BodyNode& node(int body) const { return *bodies_[body].node; }
  dart::dynamics::Skeleton& skeleton(int body) const { return *trees_[tree(body)].skeleton; }

  /// How many degrees of freedom impulses move at a body's joint.
  int dofs(int body) const;

  /// The engine's velocities of such a joint.
  double* velocities(int body) const { return bodies_[body].velocities; }

  int parent(int body) const { return bodies_[body].parent; }
  const Eigen::Isometry3d& transform(int body) const { return bodies_[body].T; }

  /// Calls `act` with the terms of a body's joint: of a MovingJoint, or of one that impulses do not move.
  template <class Act>
  void visit_joint(int body, const Act& act) const
  {
    std::visit(act, bodies_[body].joint);
  }

private:
  /// A joint with N degrees of freedom that impulses move.
  template <int N>
  struct MovingJoint
  {
    static constexpr int dofs = N;
    using Vector = Eigen::Matrix<double, N, 1>;
    using Jacobian = Eigen::Matrix<double, 6, N>;
    using Projection = typename decltype(Jacobian().transpose() * Eigen::Matrix<double, 6, 6>())::PlainObject;

    Jacobian J, K;
    Projection G;
    Eigen::Matrix<double, N, N> P;
    Vector c = Vector::Zero();      ///< Generalised impulse from outside.
    Vector tau = Vector::Zero();    ///< Total generalised impulse.
    Vector change = Vector::Zero(); ///< Velocity change dq.
  };
  struct FixedJoint
  {
    static constexpr int dofs = 0;
  };
  using JointTerms = std::variant<FixedJoint, MovingJoint<1>, MovingJoint<2>, MovingJoint<3>, MovingJoint<6>>;

  struct Body
  {
    dart::dynamics::BodyNode* node = nullptr;
    int parent = none;
    int tree = none;
    int next = none;
    int last_row = none;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    double* velocities = nullptr; ///< The engine's, of the joint that impulses move.
    JointTerms joint;
    Vector6 bias = Vector6::Zero();   ///< b
    Vector6 change = Vector6::Zero(); ///< dV
  };
  struct Tree
  {
    int first, last;
    dart::dynamics::Skeleton* skeleton;
  };

  static void read_joint(Body& body);
  template <class Space>
  static void read_moving_joint(Body& body);
  void send_up(Body& body);
  void send_down(int tree, int row);

  std::vector<Body> bodies_;
  std::vector<Tree> trees_;
  Lookup<dart::dynamics::BodyNode, int> numbers_;
};

} // namespace pydart2
