#pragma once

#include <Eigen/Geometry>
#include <dart/dynamics/GenericJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <memory>
#include <vector>

namespace pydart2 {

/// Forward dynamics, integration and impulses of a skeleton of rigid bodies: Featherstone's articulated-body algorithm
/// (Rigid Body Dynamics Algorithms, chapter 7) with implicit damping and springs, as DART's Skeleton does it, in loops
/// over links that are found once. Each sum is formed in DART's order with the same Eigen types, so that all results have
/// DART's bits.
///
/// The numbers are those that DART keeps in its bodies and joints, and so are the flags that say which are out of date:
/// no state is copied, whoever asks the engine gets the same, and what changes in a model counts at once. What makes it
/// faster is what is left out: virtual calls, reference counts, one search through the tree for each joint that moves,
/// assertions, and the second articulated inertia where neither damping nor springs make it another one.
///
/// A skeleton that moves and that no impulse acts on needs only the inertia with implicit damping and springs: the other one
/// stays out of date in the engine, which forms it when it is asked for. Where there are many skeletons, waiting for memory
/// takes most of the time. All that only serves such a step on the way is then left in numbers that all skeletons share, and
/// out of date in the same way.
///
/// Valid until the tree changes.
class TreeDynamics
{
public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /// Null for a skeleton with soft bodies or with a joint or body of a class that is not the engine's.
  static std::unique_ptr<TreeDynamics> of(dart::dynamics::Skeleton& skeleton);

  /// Whether the next step is one that the engine does in an order of its own: a locked joint that moves.
  bool is_for_engine() const;

  /// Whether there are so many links in the world that what was not touched since the step before is not in the cache.
  void set_fetch_ahead(bool enable) { fetch_ahead_ = enable; }

  /// With what hangs on the bodies, unless it has at this count of the changes of models.
  void keep_up(long changes);

  /// As Skeleton::computeForwardDynamics(), integrateVelocities(), computeImpulseForwardDynamics() and
  /// integratePositions(). Only where integrate_velocities() comes next may accelerate() leave things out of date. Where the
  /// bodies' velocities are asked for, that is done for all at once.
  void accelerate(bool may_leave = false);
  void integrate_velocities(double dt, bool asked_for = false);
  void apply_impulses();
  void integrate_positions(double dt);

  /// As Skeleton::clearConstraintImpulses().
  void clear_impulses();

  /// Bring a body's pose or velocity up to date between steps, as the engine does when it is asked for them.
  void find_pose(const dart::dynamics::BodyNode& body);
  void find_velocity(const dart::dynamics::BodyNode& body);

  /// Whether no body, since accelerate(), is farther from the origin along an axis.
  bool is_within(double distance) const;

  /// Whether of the forces of this step only the internal ones are to be cleared, and how, as
  /// Skeleton::clearInternalForces(): who looks at them in the midst of a step finds them in the cache.
  void look_at_forces(bool commands_at_rest);
  bool forces_at_rest() const { return forces_at_rest_; }
  void clear_internal_forces();

private:
  enum class Kind { none, r1, r2, r3, so3, se3 };

  /// Of a link, from one pass of a step to the next.
  struct Numbers
  {
    Matrix6 inertia_implicit;          ///< Articulated.
    Eigen::Isometry3d transform;       ///< Of the joint.
    Vector6 partial_acceleration, bias_force;
  };

  struct Link
  {
    dart::dynamics::BodyNode* body;
    dart::dynamics::Joint* joint;
    dart::dynamics::Frame* frame;
    dart::dynamics::Entity* entity;
    const dart::dynamics::Frame* parent_frame;
    Link* parent = nullptr; ///< Null at a root.
    Kind kind = Kind::none;
    std::size_t tree = 0;
    const Matrix6* inertia;
    const Vector6* external_force;
    const Eigen::Vector3d* axis = nullptr; ///< Of a revolute joint.
    dart::dynamics::UniversalJoint* universal = nullptr; ///< The joint, if it is one.
    bool constant = true;        ///< The joint's Jacobian never changes.
    std::vector<Link*> children; ///< In the engine's order, in which their sums are formed.
    std::vector<dart::dynamics::Entity*> others; ///< What else hangs on the body: shapes and markers.
    bool heard = true;                           ///< Somebody is told when those are out of date.

    Matrix6* articulated;

    // Where those of Numbers are: the engine's, or shared ones.
    Matrix6* articulated_implicit;
    Eigen::Isometry3d* transform;
    Vector6* partial_acceleration;
    Vector6* bias_force;

    bool kinematic = false; ///< Its motion is prescribed. Brought up to date by each pass.
    bool implicit = false;  ///< The articulated inertia with implicit damping and springs is another one.
    bool unread = false;    ///< Nobody had asked for its velocity before the step, so for none of the others'.
  };

  explicit TreeDynamics(dart::dynamics::Skeleton& skeleton);
  bool add(dart::dynamics::BodyNode& body, Link* parent);

  /// At what hangs on the bodies.
  void look();

  template <class Visit>
  static void visit(const Link& link, Visit&& visit);

  void update_motion(Link& link);
  void update_transform(Link& link);
  static void update_universal(dart::dynamics::UniversalJoint& joint);
  static void update_pose(Link& link);
  void update_velocity(Link& link);
  void find_pose(Link& link);
  void find_velocity(Link& link);
  void update_inertias(bool only_implicit = false);
  static void update_inertia(Link& link, double dt);
  static void update_implicit_inertia(Link& link, double dt);
  static void add_child_inertia(const Link& child, const Matrix6& inertia, bool implicit, Matrix6& sum);
  static void update_bias_force(Link& link, const Eigen::Vector3d& gravity, double dt);
  static void add_child_bias_force(const Link& child, Vector6& sum);
  template <class Space>
  static void update_total_force(
      dart::dynamics::GenericJoint<Space>& joint, const Link& link, const Vector6& force, double dt);
  void update_acceleration(Link& link, double dt);
  template <class Space>
  static void update_driving_force(dart::dynamics::GenericJoint<Space>& joint, const Link& link, double dt);
  static void update_bias_impulse(Link& link);
  static void update_velocity_change(Link& link, double dt);

  /// Whether what only serves the next pass on the way is out of date by its end anyway, and is not asked for then.
  bool moves_on() const;
  void put_numbers(Numbers* shared);

  void mark_positions();
  void mark_velocities();
  void mark_predicted_velocities();
  void mark_accelerations();
  static void mark_position(Link& link);
  static void mark_velocity(Link& link);
  static void mark_acceleration(Link& link);
  static void mark_rates(Link& link);
  void mark_predicted_velocity(Link& link);
  template <class Mark>
  void each_cache(const Mark& mark);

  /// Have memory of the i-th link, if there is one, brought to the cache while another one is computed.
  void fetch_numbers(std::size_t i) const;
  void fetch_flags(std::size_t i) const;

  dart::dynamics::Skeleton& skeleton_;
  std::vector<std::unique_ptr<Link>> links_; ///< Parents first.
  std::vector<Link*> by_body_;               ///< In the order of the skeleton's bodies.
  long changes_ = -1; ///< That it has kept up with.
  bool fetch_ahead_ = false;
  Numbers* shared_ = nullptr; ///< Where numbers are; null for the engine's.
  bool moved_ = false;        ///< In the last step.
  bool pushed_off_ = false;   ///< By impulses, in the last step.
  bool forces_at_rest_ = false;
};

} // namespace pydart2
