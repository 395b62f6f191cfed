#pragma once

#include <array>
#include <atomic>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "dynamics/armature.hpp"
#include "dynamics/bias_forces.hpp"
#include "dynamics/dynamics_choice.hpp"
#include "dynamics/integrator.hpp"
#include "dynamics/mass_matrix.hpp"
#include "dynamics/stable_pd.hpp"
#include "engine/collision_filter.hpp"
#include "state/constraint_record.hpp"
#include "state/dof_state.hpp"
#include "state/recording.hpp"
#include "state/step_plan.hpp"

namespace pydart2 {

class StateWatch; // stepping.cpp
class TreeDynamics;

enum class RootChange { trans_and_euler, weld, free };

/// A skeleton of a world, shared by all handles into it, and where it came from.
struct SkeletonRecord
{
  dart::dynamics::SkeletonPtr skeleton;

  std::string source = {};    ///< ModelSource::packed() of what it was loaded from; empty if it came with the world.
  bool recorded = false;      ///< Whether a frame of the recording has its states.
  bool built = false;         ///< In code, or changed since it was loaded: what it is made again from is itself.
  int index_in_source = -1;   ///< Where it was in the world that it came with.
  std::vector<RootChange> root_changes = {};

  /// m: no shape is farther from its body's origin. Unknown since the skeleton may have changed.
  std::optional<double> shapes_reach;

  bool limits_checked = false; ///< Since the last change of a limit or of what acts on it (state/limits.hpp).

  /// A dof and where it is far beyond limits that do not act, until one was.
  struct FarBeyond
  {
    std::size_t dof;
    double low, high;
  };
  std::vector<FarBeyond> far_beyond = {};
  bool told_of_limits = false;

  /// Counts changes of the tree: a handle to a body, joint or dof made before the last one is refused.
  int structure = 0;

  std::shared_ptr<StateWatch> watch = nullptr;

  Armature armature = {};
  Motors motors = {};

  /// Where the engine keeps the state, found again when the tree has changed.
  const DofState& dofs();

  std::optional<DofState> found_dofs;
  int found_structure = 0;

  /// The forces last set, which stay when a step clears the engine's. Those of a tree that has changed are the engine's.
  Eigen::VectorXd& last_forces();

  /// From now on they are the engine's.
  void forget_last_forces() { last_forces_structure = -1; }

  Eigen::VectorXd remembered_forces = {};
  int last_forces_structure = -1;

  /// After a blow-up that is not raised: what is read instead, until a state is set. The engine has the last sane one.
  std::optional<DofState> not_numbers;

  /// Moves it as the engine does, but faster; null where the engine has to. Made again when the tree has changed.
  TreeDynamics* dynamics();

  std::shared_ptr<TreeDynamics> made_dynamics = nullptr;
  int dynamics_structure = -1;
  TreeDynamics* mover = nullptr; ///< What moves it in the present step, null for the engine.

  /// Over its tree, for who asks. Made again when it has changed.
  struct Passes
  {
    LinkTree tree;
    MassMatrix mass_matrix;
    BiasForces bias_forces;
  };
  Passes& passes();

  std::optional<Passes> made_passes;
  int passes_structure = -1;

  /// Made again when the tree has changed.
  SkeletonIntegrator& integrator();

  std::optional<SkeletonIntegrator> made_integrator;
  int integrator_structure = -1;
  int free = -1;             ///< Its place in the plan's free bodies.
  long changed_in = -1;      ///< The round of the plan in which it may have changed.
  int island = 0;            ///< With which it sleeps; 0 if it is awake (state/sleeping.hpp).
  double quiet = 0.0;        ///< s for which it has been slow.
  bool controlled = false;   ///< By a function of the user's, so that it never sleeps.

  long integrator_fallbacks = 0; ///< Steps by the engine's rule where the world has another, since it was chosen.
};
using SkeletonRef = std::shared_ptr<SkeletonRecord>;

/// Who sleeps, and when one falls asleep (state/sleeping.hpp).
struct Sleep
{
  bool enabled = false;
  double linear = 5e-3;  ///< m/s, for a body of 1 m; it grows with the root of the size.
  double angular = 1e-2; ///< rad/s
  double seconds = 0.5;

  struct Contact
  {
    int island;
    std::array<double, 16> row; ///< state/contact.hpp
  };
  std::vector<Contact> contacts; ///< Those of the sleepers, as they fell asleep.
  std::unordered_set<const dart::dynamics::Skeleton*> asleep;
  std::vector<std::shared_ptr<SkeletonRecord>> awake; ///< The others, in their order, while sleeping is on.
  std::vector<dart::dynamics::SkeletonPtr> awake_skeletons;
  int last_island = 0;
  int version = 0;               ///< Of who sleeps.
  bool contacts_found = false;   ///< Also those of the sleepers, by the last collision detection.
};

/// The digest of a model, and the model that it is of (state/model_archive.hpp).
struct KnownModel
{
  struct Part
  {
    std::vector<std::string> texts;
    std::vector<double> numbers;
  };
  Part all, around; ///< Around the skeletons: of the world itself.
  long changes = -1;
  std::string digest;
};

/// A world and what belongs to it, shared by all handles into it.
struct WorldRecord
{
  /// busy: a call that released the interpreter lock is inside the engine.
  enum class State { ready, busy, destroyed };

  WorldRecord(int id, dart::simulation::WorldPtr world, std::string source);
  ~WorldRecord() { clear(); }

  /// Frees what belongs to the world.
  void clear();

  /// The present state and contacts, as a frame more of the recording.
  void record_frame();

  /// Throws unless this world may be used now.
  void check() const
  {
    const State seen = state.load(std::memory_order_acquire);
    if (seen != State::ready)
      refuse(seen);
  }

  /// From now on a skeleton reads NaN, and steps change only the time.
  void become_not_numbers(SkeletonRecord& skeleton);

  /// One skeleton, or all, read again what the engine has.
  void become_numbers(SkeletonRecord& skeleton);
  void become_numbers();

  /// To be called when a tree has changed: handles to its parts and what was recorded no longer fit.
  void tree_changed(SkeletonRecord& skeleton);

  /// Throws what a state other than ready means.
  [[noreturn]] void refuse(State seen) const;

  /// Adds a skeleton that was loaded from `source`, or built if that is empty.
  void add(const dart::dynamics::SkeletonPtr& skeleton, const std::string& source);

  /// `name`, or if a skeleton has it the first of "name (1)", "name (2)" ... that none has.
  std::string free_name(const std::string& name);

  /// Those that a step has to look at: all but the sleepers.
  const std::vector<SkeletonRef>& awake() const { return sleep.asleep.empty() ? skeletons : sleep.awake; }

  /// To be called when a skeleton is about to change: it does not stay asleep, nor does what it carries.
  void about_to_change(SkeletonRecord& skeleton);

  /// Index of a skeleton in this world, -1 if it is not in it.
  int index_of(const dart::dynamics::ConstSkeletonPtr& skeleton) const;

  const int id;
  dart::simulation::WorldPtr world;
  const std::string source; ///< ModelSource::packed() of what it was loaded from; empty if it was made empty.
  std::vector<SkeletonRef> skeletons;
  std::vector<ConstraintRecord> constraints;
  int last_constraint = 0; ///< The highest id so far.
  std::vector<std::pair<dart::dynamics::BodyNode*, dart::dynamics::BodyNode*>> ignored_pairs;
  engine::BitsOfBodies collision_bits;
  std::atomic<State> state{State::ready};
  long frame = 0; ///< Steps since the last reset.
  long changes = 0; ///< How often a skeleton may have changed, its state or its model.
  KnownModel known_model;
  int layout = 0; ///< Changes when skeletons are removed or get another tree, so that an earlier frame no longer fits.
  bool shapes_changed = false; ///< Since the detector got them, which then has them in another order than a clone's.
  Dynamics dynamics = default_dynamics();
  Integrator integrator = Integrator::engine;
  bool told_of_contact_limit = false; ///< The warning came.
  bool told_of_large_group = false;
  bool deterministic = false; ///< Each step begins without what detectors and constraints remember.
  bool nan_at_blow_up = false; ///< Instead of an error.
  bool blown_up = false; ///< Some skeleton reads NaN.
  Recording recording;
  Sleep sleep;
  StepPlan plan;

private:
  std::map<std::string, int> last_numbers_; ///< Of the names that free_name() has numbered.
};
using WorldRef = std::shared_ptr<WorldRecord>;

/// Fills the engine's filter, which holds bare pointers, anew from the record.
void apply_collision_filter(WorldRecord& world);

/// Whether two bodies pass through each other because someone said so.
bool passes_through(const WorldRecord& world, const dart::dynamics::BodyNode& a, const dart::dynamics::BodyNode& b);

/// Takes bodies that are about to go out of the collision filter.
void forget_in_filter(WorldRecord& world, const std::set<const dart::dynamics::BodyNode*>& gone);

/// Marks a world busy for the time of a long call, so that a second thread is refused instead of racing.
class Busy
{
public:
  explicit Busy(WorldRecord& world);
  ~Busy() { world_.state.store(after_, std::memory_order_release); }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

  /// The world is destroyed when this call ends.
  void destroy() { after_ = WorldRecord::State::destroyed; }

private:
  WorldRecord& world_;
  WorldRecord::State after_ = WorldRecord::State::ready;
};

} // namespace pydart2
