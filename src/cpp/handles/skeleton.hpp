#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/arrays.hpp"
#include "handles/bodynode.hpp"
#include "handles/dof.hpp"
#include "handles/dynamics.hpp"
#include "handles/inverse_kinematics.hpp"
#include "handles/joint.hpp"
#include "handles/marker.hpp"
#include "handles/part.hpp"
#include "handles/targets.hpp"
#include "loading/built_skin.hpp"
#include "state/dof_state.hpp"

namespace pydart2 {

/// dart::dynamics::Skeleton. A vector over the dofs comes out as a vector "like" the one passed in: new with the same
/// names if that is a pattern (named_vector.hpp), else written to it.
class SkeletonHandle
{
public:
  SkeletonHandle(WorldRef world, SkeletonRef skeleton);

  /// Index in the world, -1 if it was removed.
  int id() const;
  std::string name() const;
  std::string set_name(const std::string& name);
  double mass() const;
  bool is_mobile() const;
  void set_mobile(bool mobile);
  bool is_asleep() const;

  /// One that a function of the user's acts on never sleeps.
  void set_controlled(bool controlled);
  bool self_collision_check() const;
  void set_self_collision_check(bool enable);
  bool adjacent_body_check() const;
  void set_adjacent_body_check(bool enable);

  int num_bodynodes() const;
  int num_joints() const;
  int num_dofs() const;
  int num_markers() const;
  BodyNodeHandle bodynode(long index) const;
  JointHandle joint(long index) const;
  DofHandle dof(long index) const;
  MarkerHandle marker(long index) const;
  std::vector<std::string> dof_names() const;
  DynamicsHandle dynamics() const;
  InverseKinematicsHandle inverse_kinematics() const;
  TargetsHandle targets() const;

  void positions(Output& like) const;
  void velocities(Output& like) const;
  void accelerations(Output& like) const;
  void forces(Output& like) const;
  /// Those that a step has cleared too.
  void last_forces(Output& like) const;
  void set_last_forces(const VectorIn& forces);
  void commands(Output& like) const;
  void set_positions(const VectorIn& positions);
  void set_velocities(const VectorIn& velocities);
  void set_accelerations(const VectorIn& accelerations);
  void set_forces(const VectorIn& forces);
  void set_commands(const VectorIn& commands);

  /// [q, dq].
  void states(Output& into) const;
  void set_states(const VectorIn& states);

  /// q1 - q2 and dq1 - dq2 on the configuration manifold.
  void position_differences(const VectorIn& q1, const VectorIn& q2, Output& out) const;
  void integrate_positions(const VectorIn& q, const VectorIn& velocities, Output& out) const;
  void velocity_differences(const VectorIn& dq1, const VectorIn& dq2, Output& out) const;

  void position_lower_limits(Output& out) const;
  void position_upper_limits(Output& out) const;
  void force_lower_limits(Output& out) const;
  void force_upper_limits(Output& out) const;

  void mass_matrix(Output& into) const;
  void inv_mass_matrix(Output& into) const;
  void coriolis_and_gravity_forces(Output& into) const;
  void coriolis_forces(Output& out) const;
  void gravity_forces(Output& out) const;
  void external_forces(Output& out) const;
  void constraint_forces(Output& into) const;

  void com(Output& into) const;
  Eigen::Vector3d com_velocity() const;
  Eigen::Vector3d com_acceleration() const;
  Vector6d com_spatial_velocity() const;
  double kinetic_energy() const;
  double potential_energy() const;

  void clear_external_forces();
  void clear_impulse();
  void update_fk() const;

  /// A new massless root under TranslationalJoint root_t, the old root below it under EulerJoint root_r (XYZ).
  /// Positions are not converted. Every handle into this skeleton must be taken again.
  void set_root_joint_to_trans_and_euler();

  /// Every handle into this skeleton must be taken again.
  void set_root_joint_to_weld();

  /// A root that is fixed floats from where it is.
  void set_root_joint_to_free();

  /// Adds a body without mass to a parent, -1 for the world; returns its index. The joint is of the engine's type; the
  /// axes are rows, as many as the type has. Every handle into this skeleton must be taken again.
  int add_body(long parent, const std::string& name, const std::string& joint_type, const std::string& joint_name, const MatrixIn& axes);

  /// The same with a skin of point masses, whose shape is the body's first. Edges and faces are indices of points.
  int add_soft_body(
      long parent,
      const std::string& name,
      const std::string& joint_type,
      const std::string& joint_name,
      const MatrixIn& axes,
      const MatrixIn& points,
      const VectorIn& masses,
      const MatrixIn& edges,
      const MatrixIn& faces);

  /// Takes a body away, with all that hangs from it. Every handle into this skeleton must be taken again.
  void remove_body(long index);

  /// Moves a body of a skeleton of the world with all that hangs from it to a parent here, -1 for the world; their new
  /// names, parents first. The joint is as in add_body(); without a type it keeps its own. Every handle into both
  /// skeletons must be taken again.
  std::vector<std::string> move_branch(
      long of_skeleton,
      long body,
      long parent,
      const std::string& joint_type,
      const std::string& joint_name,
      const MatrixIn& axes);

  /// Adds a copy of such a branch, its joints and state, bits and pairs of the collision filter; its first body's index.
  int copy_branch(long of_skeleton, long body, long parent);

  /// Steps by the engine's rule since the world got another integrator.
  long integrator_fallbacks() const;

private:
  dart::dynamics::Skeleton& skeleton() const { return *skeleton_; }
  dart::dynamics::Skeleton& skeleton() { return *skeleton_; } ///< To change it.
  const std::vector<dart::dynamics::DegreeOfFreedom*>& dofs() const { return skeleton().getDofs(); }
  const std::vector<dart::dynamics::DegreeOfFreedom*>& dofs() { return skeleton().getDofs(); }
  dart::dynamics::Skeleton& with_mass() const;
  const dart::dynamics::Skeleton& moving() const; ///< With mass, and poses and velocities up to date.
  void forget_root_armature(); ///< The joint goes.
  void check_root_can_change(const char* what) const;
  void check_tree_can_change(const char* what) const;
  dart::dynamics::BodyNode* parent_at(long index) const; ///< Null for -1, the world.
  void tree_changed(RootChange change);
  int add_new(
      long parent,
      const std::string& name,
      const std::string& joint_type,
      const std::string& joint_name,
      const MatrixIn& axes,
      const built::Skin* skin);
  void check_new_name(const std::string& name, bool taken, const char* what) const;

  /// Places of the engine's numbers, or of NaN after a blow-up that was not raised.
  const DofState& state() const;

  /// Writes the numbers at the given places, or one number of each dof.
  void gather(const std::vector<const double*>& places, Output& out) const;
  template <class Read>
  void each_dof(Output& out, Read read) const;

  /// Checks the vector and copies it to where DART takes it from without an allocation.
  const Eigen::VectorXd& per_dof(const VectorIn& values, const char* what);

  Part<dart::dynamics::Skeleton, dart::dynamics::Skeleton*> skeleton_; // SkeletonRecord owns it
  Eigen::VectorXd scratch_;
  std::array<Eigen::VectorXd, 7> joint_scratch_; // by the number of dofs
};

} // namespace pydart2
