#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/arrays.hpp"
#include "handles/bodynode.hpp"
#include "handles/skeleton.hpp"
#include "loading/model_source.hpp"
#include "state/blueprint.hpp"
#include "state/world_record.hpp"

namespace pydart2 {

/// Ends all worlds, starts ids at 0 again and forgets which messages came already.
void restart();

/// dart::simulation::World, its contacts and its recording.
class WorldHandle
{
public:
  /// An empty world with DART's own gravity.
  explicit WorldHandle(double time_step);

  /// The world of a model source that has one; LoadError if reading takes more seconds of the processor. What is known to
  /// be quick is read on this thread: in a process that has had another, counting references takes longer ever after.
  static WorldHandle load(const ModelSource& source, double seconds, bool is_quick);

  /// The world of an id, if it lives.
  static WorldHandle find(long id);

  int id() const { return record_->id; }
  void destroy();

  int num_skeletons() const;
  SkeletonHandle skeleton(long index) const;

  /// Adds the skeleton of a model source; returns its index. As load().
  int add_skeleton(const ModelSource& source, double seconds, bool is_quick);

  /// Adds a skeleton without bodies, to be built; returns its index. Another name is given if this one is taken.
  int add_empty_skeleton(const std::string& name);
  void remove_skeleton(long index);

  double time() const;
  void set_time(double time);
  double time_step() const;
  void set_time_step(double time_step);
  Eigen::Vector3d gravity() const;
  void set_gravity(const Eigen::Vector3d& gravity);

  long frame() const;

  /// Time 0, initial positions and velocities, no forces, no impulses, a new recording.
  void reset();
  void step(long count);
  void check_collision();

  /// [q, dq] of each skeleton, one after another.
  void states(Output& into) const;
  void set_states(const VectorIn& states);

  /// "dart", "fcl", "bullet" or "ode".
  std::string collision_detector() const;
  void set_collision_detector(const std::string& name);

  /// Shapes that a detector of the engine's does not have are what the engine makes of them.
  void use_engine_shapes();

  /// "engine" or "fast".
  std::string dynamics() const;
  void set_dynamics(const std::string& name);
  std::string integrator() const;
  void set_integrator(const std::string& name);

  /// "fast", "dart" or "iterative".
  std::string constraint_solver() const;
  void set_constraint_solver(const std::string& name);

  /// Iterations, tolerance, friction (0 pyramid, 1 cone, 2 engine), split, error reduction, allowance, correction speed.
  /// Setting them chooses the iterative solver; choosing a solver by its name sets them back.
  void iterative_options(Output& out) const;
  void set_iterative_options(const VectorIn& options);

  /// Of the iterative solver's last step.
  int solver_iterations() const;
  double solver_residual() const;

  /// At most four contacts of each pair of faces.
  bool deterministic() const;
  void set_deterministic(bool enable);
  bool nan_at_blow_up() const;
  void set_nan_at_blow_up(bool enable);

  bool contact_reduction() const;
  void set_contact_reduction(bool enable);
  bool warm_start() const;
  void set_warm_start(bool enable);

  /// Linear speed (m/s for a body of 1 m), angular speed (rad/s), and for how long slower ones stay awake (s); none for off.
  void sleeping_options(Output& out) const;
  void set_sleeping_options(const VectorIn& options);

  /// How many contacts a step takes, 0 for as many as there are.
  long max_contacts() const;
  void set_max_contacts(long most);
  double constraint_error_reduction() const;
  void set_constraint_error_reduction(double share);
  double contact_memory_limit() const;
  void set_contact_memory_limit(double bytes);

  /// Each of some bodies with each of others do not collide, or do again; rows of skeleton and body.
  void ignore_pairs(const MatrixIn& a, const MatrixIn& b, bool ignore);
  void ignore_no_pair();

  /// Rows of skeleton and body of the one, skeleton and body of the other.
  void ignored_pairs(Output& out) const;

  /// Of bodies, rows of skeleton and body: they collide only where each's mask has a bit of the other's group.
  void set_collision_bits(const MatrixIn& bodies, double group, double mask);
  void collision_bits(const BodyNodeHandle& body, Output& out) const;

  int num_contacts() const;

  /// One row per contact (contact.hpp).
  void contacts(Output& out) const;

  void add_ball_joint_constraint(const BodyNodeHandle& body1, const BodyNodeHandle& body2, const Eigen::Vector3d& point);
  int num_constraints() const;

  /// Kind: 0 ball, at a point of the world, 1 weld, as the bodies stand, 2 revolute, about an axis through a point, 3
  /// distance of two points. Numbers: point (3), axis (3), second point (3), length, whether it is a rope. Returns the id.
  int add_constraint_between(
      long kind, const BodyNodeHandle& body1, const BodyNodeHandle& body2, const VectorIn& numbers);
  int add_constraint_to_world(long kind, const BodyNodeHandle& body, const VectorIn& numbers);

  /// Of an id; a constraint that is no longer there is an error.
  bool constraint_is_enabled(long id) const;
  void set_constraint_enabled(long id, bool on);
  void set_constraint_target(long id, const Eigen::Matrix4d& target);

  /// Moment about the first body's origin and force on it, world axes, in the last step.
  Vector6d constraint_wrench(long id) const;

  /// Id, kind, skeleton and body id of the first body, of the second (-1 for the world), and its numbers.
  void constraint(long index, Output& out) const;

  /// False if there is none of this id.
  bool remove_constraint(long id);
  void remove_all_constraints();

  /// What the detector and the constraints remember of earlier steps; the next steps are then those of a copy, bit for bit.
  void forget_history();

  /// All that a step changes and the next one depends on.
  void snapshot(Output& out);
  void restore(const VectorIn& snapshot);

  /// All that a user may have changed and a step does not.
  std::vector<std::string> model_texts() const;
  void model_numbers(Output& out) const;

  /// The digest that was remembered, "" if the model has changed since.
  std::string known_model_digest() const;
  void remember_model_digest(const std::string& digest) const;

  /// What rebuild() makes a world of its own from that is equal in everything but its recording, which is off.
  Blueprint blueprint() const;
  static WorldHandle rebuild(const Blueprint& blueprint);

  bool is_recording() const;
  void set_recording(bool enable);
  long num_frames() const;
  long first_frame() const;

  /// Puts the states of a recorded frame back; false if it is not kept. Time and frame stay as they are.
  bool set_frame(long index);
  void frame_states(long index, Output& out) const;
  void frame_contacts(long index, Output& out) const;

  /// Indices of the skeletons that slept, -1 of those that have gone since.
  void frame_sleepers(long index, Output& out) const;

  /// The times of all kept frames.
  void recorded_times(Output& out) const;

  /// The states of all kept frames, as rows; NaN where a skeleton was not there yet, and where another has gone since.
  void recorded_states(Output& out) const;
  void clear_recording();
  void record_frame();
  long recording_bytes() const;
  long recording_limit() const;
  void set_recording_limit(long bytes);

  /// For add_skeleton(), step(), check_collision() and clone(), whose caller holds it. Refuses a world in use.
  Busy claim() const { return Busy(*record_); }

  /// For the C++ of this layer.
  const WorldRef& ref() const { return record_; }

private:
  int add_constraint(long kind, dart::dynamics::BodyNode& a, dart::dynamics::BodyNode* b, const VectorIn& numbers);
  ConstraintRecord& constraint_of(long id) const;
  explicit WorldHandle(WorldRef record);
  WorldRecord& world() const;
  WorldRecord& to_change(); ///< All wake.

  WorldRef record_;
};

} // namespace pydart2
