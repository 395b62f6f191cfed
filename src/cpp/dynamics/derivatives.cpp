#include "dynamics/derivatives.hpp"

#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <vector>

namespace pydart2 {

namespace {

using Eigen::Matrix3d;
using Eigen::Matrix6d;
using Eigen::Vector3d;
using Eigen::Vector6d;
using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>; ///< Columns [angular; linear], at most six.

Matrix3d skew(const Vector3d& v)
{
  return (Matrix3d() << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0).finished();
}

/// v x, of motions; its negative transpose is v x* of forces (Featherstone, section 2.9).
Matrix6d cross(const Vector6d& v)
{
  Matrix6d matrix;
  matrix << skew(v.head<3>()), Matrix3d::Zero(), skew(v.tail<3>()), skew(v.head<3>());
  return matrix;
}

/// What takes a motion m to m x* f.
Matrix6d cross_on(const Vector6d& f)
{
  Matrix6d matrix;
  matrix << -skew(f.head<3>()), -skew(f.tail<3>()), -skew(f.tail<3>()), Matrix3d::Zero();
  return matrix;
}

/// A joint whose axes do not turn each other, and the body that it moves, if any.
struct Node
{
  int parent, first_dof;
  Motions J; ///< Of its dofs.
  Vector6d v, a;
  // Sums over the node and all after it: inertia, that of the bodies with gravity, what makes a force of a velocity, force.
  Matrix6d I = Matrix6d::Zero(), heavy = Matrix6d::Zero(), B = Matrix6d::Zero();
  Vector6d F = Vector6d::Zero();
};

/// Places, seen from the tree's root, in the world's axes.
class Recursion
{
public:
  Recursion(const dart::dynamics::Skeleton& skeleton, std::size_t tree, const Eigen::VectorXd& ddq)
    : ddq_(ddq), dq_(skeleton.getVelocities()), origin_(skeleton.getRootBodyNode(tree)->getWorldTransform().translation())
  {
    gravity_ << Vector3d::Zero(), skeleton.getGravity();
    add(*skeleton.getRootBodyNode(tree), -1);
    for (std::size_t i = nodes_.size(); i-- > 1;)
      gather(nodes_[i], nodes_[static_cast<std::size_t>(nodes_[i].parent)]);
  }

  void write(InverseDynamicsDerivatives& out) const
  {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      for (long k = 0; k < nodes_[i].J.cols(); ++k)
        write_column(static_cast<int>(i), k, out);
  }

private:
  void add(const dart::dynamics::BodyNode& body, int parent)
  {
    const auto& joint = *body.getParentJoint();
    const auto dofs = static_cast<long>(joint.getNumDofs());
    const Motions J = to_world(body, joint.getRelativeJacobian());
    const int first = dofs == 0 ? 0 : static_cast<int>(joint.getIndexInSkeleton(0));
    const auto& type = joint.getType();
    if (dofs < 2 || type == dart::dynamics::BallJoint::getStaticType() || type == dart::dynamics::FreeJoint::getStaticType())
      parent = add_node(parent, first, J);
    else
      for (int k = 0; k < static_cast<int>(dofs); ++k)
        parent = add_node(parent, first + k, J.col(k));
    add_body(body, nodes_[static_cast<std::size_t>(parent)]);
    for (std::size_t i = 0; i < body.getNumChildBodyNodes(); ++i)
      add(*body.getChildBodyNode(i), parent);
  }

  int add_node(int parent, int first_dof, const Motions& J)
  {
    const Vector6d none = Vector6d::Zero();
    const Vector6d &v = velocity(parent), &a = parent < 0 ? none : nodes_[static_cast<std::size_t>(parent)].a;
    Node node{parent, first_dof, J, v, a};
    if (J.cols() > 0) {
      const Vector6d own = J * dq_.segment(first_dof, J.cols());
      node.v += own;
      node.a += J * ddq_.segment(first_dof, J.cols()) + cross(node.v) * own;
    }
    nodes_.push_back(node);
    return static_cast<int>(nodes_.size()) - 1;
  }

  void add_body(const dart::dynamics::BodyNode& body, Node& node) const
  {
    const Matrix3d R = body.getWorldTransform().linear();
    const Matrix6d& in_body = body.getSpatialInertia(); // [[I, [h]], [[h]^T, m 1]]
    const double m = in_body(3, 3);
    const Vector3d p = body.getWorldTransform().translation() - origin_;
    const Vector3d h = R * Vector3d(in_body(2, 4), in_body(0, 5), in_body(1, 3));
    const Matrix3d moved = skew(h) * skew(p) + skew(p) * skew(h) + m * skew(p) * skew(p), first = skew(h + m * p);
    node.I << R * in_body.topLeftCorner<3, 3>() * R.transpose() - moved, first, first.transpose(), m * Matrix3d::Identity();
    const Vector6d momentum = node.I * node.v;
    node.F = node.I * node.a - cross(node.v).transpose() * momentum;
    if (body.getGravityMode()) {
      node.heavy = node.I;
      node.F -= node.I * gravity_;
    }
    node.B = cross_on(momentum) - node.I * cross(node.v) - cross(node.v).transpose() * node.I;
  }

  static void gather(const Node& node, Node& parent)
  {
    parent.I += node.I;
    parent.heavy += node.heavy;
    parent.B += node.B;
    parent.F += node.F;
  }

  /// By one dof: all that it carries turns about its axis, forces too; and, seen from there, what moves it turns back.
  void write_column(int index, long k, InverseDynamicsDerivatives& out) const
  {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    const Vector6d axis = node.J.col(k), &v = velocity(node.parent), none = Vector6d::Zero();
    const Vector6d& a = node.parent < 0 ? none : nodes_[static_cast<std::size_t>(node.parent)].a;
    const Change by_q{cross(v) * axis, cross(a) * axis + cross(v) * (cross(v) * axis), cross(axis) * gravity_};
    const Change by_dq{axis, cross(node.v + v) * axis, none};
    const long column = node.first_dof + k;
    // On the forces of the dofs before it,
    const Vector6d force = force_of(node, by_q) - cross(axis).transpose() * node.F, rate = force_of(node, by_dq);
    for (int i = node.parent; i >= 0; i = nodes_[static_cast<std::size_t>(i)].parent)
      write(nodes_[static_cast<std::size_t>(i)], force, rate, column, out);
    // and of those that it carries: their axes turn with their forces.
    auto i = static_cast<std::size_t>(index);
    do
      write(nodes_[i], force_of(nodes_[i], by_q), force_of(nodes_[i], by_dq), column, out);
    while (++i < nodes_.size() && nodes_[i].parent >= index);
  }

  /// Of the velocity and the acceleration of all bodies from some node on; gravity turns back too.
  struct Change
  {
    Vector6d v, a, gravity;
  };

  static Vector6d force_of(const Node& node, const Change& change)
  {
    return node.I * change.a + node.B * change.v + node.heavy * change.gravity;
  }

  static void write(
      const Node& node, const Vector6d& force, const Vector6d& rate, long column, InverseDynamicsDerivatives& out)
  {
    out.by_q.col(column).segment(node.first_dof, node.J.cols()) = node.J.transpose() * force;
    out.by_dq.col(column).segment(node.first_dof, node.J.cols()) = node.J.transpose() * rate;
  }

  const Vector6d& velocity(int node) const
  {
    static const Vector6d none = Vector6d::Zero();
    return node < 0 ? none : nodes_[static_cast<std::size_t>(node)].v;
  }

  Motions to_world(const dart::dynamics::BodyNode& body, const dart::math::Jacobian& in_body) const
  {
    const Matrix3d R = body.getWorldTransform().linear();
    const Vector3d p = body.getWorldTransform().translation() - origin_;
    Motions J(6, in_body.cols());
    J.topRows<3>() = R * in_body.topRows<3>();
    J.bottomRows<3>() = R * in_body.bottomRows<3>() + skew(p) * J.topRows<3>();
    return J;
  }

  const Eigen::VectorXd& ddq_;
  Eigen::VectorXd dq_;
  Vector3d origin_;
  Vector6d gravity_;
  std::vector<Node> nodes_; ///< Depth first: those that a node carries follow it.
};

} // namespace

InverseDynamicsDerivatives inverse_dynamics_derivatives(const dart::dynamics::Skeleton& skeleton, const Eigen::VectorXd& ddq)
{
  const long n = ddq.size();
  InverseDynamicsDerivatives out{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (std::size_t tree = 0; tree < skeleton.getNumTrees(); ++tree)
    Recursion(skeleton, tree, ddq).write(out);
  return out;
}

} // namespace pydart2
