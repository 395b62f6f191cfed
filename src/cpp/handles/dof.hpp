#pragma once

#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <string>

#include "handles/part.hpp"

namespace pydart2 {

/// dart::dynamics::DegreeOfFreedom. rad or m, rad/s or m/s, N m or N.
class DofHandle
{
public:
  DofHandle(WorldRef world, SkeletonRef skeleton, dart::dynamics::DegreeOfFreedom* dof);

  std::string name() const;
  int index_in_skeleton() const;
  int index_in_tree() const;
  int index_in_joint() const;
  int tree_index() const;

  double position() const;
  void set_position(double position);
  double initial_position() const;
  void set_initial_position(double position);
  bool has_position_limit() const;
  double position_lower_limit() const;
  void set_position_lower_limit(double limit);
  double position_upper_limit() const;
  void set_position_upper_limit(double limit);

  double velocity() const;
  void set_velocity(double velocity);
  double initial_velocity() const;
  void set_initial_velocity(double velocity);
  double velocity_lower_limit() const;
  void set_velocity_lower_limit(double limit);
  double velocity_upper_limit() const;
  void set_velocity_upper_limit(double limit);

  double acceleration() const;
  void set_acceleration(double acceleration);

  double force() const;
  void set_force(double force);
  double force_lower_limit() const;
  void set_force_lower_limit(double limit);
  double force_upper_limit() const;
  void set_force_upper_limit(double limit);
  double command() const;
  void set_command(double command);

  double spring_stiffness() const;
  void set_spring_stiffness(double stiffness);
  double rest_position() const;
  void set_rest_position(double position);
  double damping_coefficient() const;
  void set_damping_coefficient(double coefficient);
  /// Inertia of what turns with the joint, on the diagonal of the mass matrix.
  double armature() const;
  void set_armature(double inertia);
  double coulomb_friction() const;
  void set_coulomb_friction(double friction);

  double constraint_impulse() const;
  void set_constraint_impulse(double impulse);

private:
  Part<dart::dynamics::DegreeOfFreedom, dart::dynamics::DegreeOfFreedomPtr> dof_;
};

} // namespace pydart2
