#pragma once

#include <dart/collision/CollisionResult.hpp>
#include <dart/constraint/ConstraintBase.hpp>
#include <dart/constraint/SmartPointer.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include "contact/block_system.hpp"
#include "contact/contact_memory.hpp"
#include "contact/contact_terms.hpp"
#include "contact/movers.hpp"

namespace pydart2 {

/// Solves contacts and constraints by sweeps (block_system.hpp), in time that grows with their number: a row is a vector
/// over the velocities of what it moves, its column of M^-1 J' another, and there is no matrix over a group. Contacts
/// are taken as the detector has them; the engine's constraints that are not contacts are read.
class IterativeSolver
{
public:
  IterativeOptions options;

  /// Of the skeletons of a world; `same` if none has changed since the step before but for its state.
  void begin_step(const std::vector<dart::dynamics::SkeletonPtr>& skeletons, bool same, FreeBodies* free);

  /// Whether it knows a constraint that is not a contact.
  static bool knows(const dart::constraint::ConstraintBase& constraint);

  /// What the next solve() is about; a constraint without rows is left out.
  void add(const dart::constraint::ConstraintBasePtr& constraint)
  {
    if (constraint->getDimension() > 0)
      constraints_.push_back(constraint);
  }
  /// `touch` of the native detector, or null.
  void add(dart::collision::Contact& contact, const native::Touch* touch)
  {
    contacts_.push_back(reader_.read(contact, touch));
    contacts_.back().touch = touch;
    if (contact.penetrationDepth < 0.0 && contacts_.back().bounces()) // else it would come to rest where it should bounce
      contacts_.pop_back();
  }

  /// Finds the impulses, which are remembered for the next step, and hands them to the trees; the contacts get their
  /// forces. `doubt` a detector whose depths may be wrong and that does not see what nearly touches. Free bodies have
  /// theirs when move_free_bodies() is called, but for those in an array, which have theirs at once.
  void solve(double time_step, bool warm, bool reduce, bool doubt);
  void move_free_bodies(double time_step);

  /// Adds to the velocities of joints what takes depth away, for the time of an integration of positions; and takes it
  /// off, bit for bit.
  void add_corrections();
  void take_off_corrections();

  /// Of the last step: of all islands the largest. The residual of a row is what a step of projection changes of it,
  /// W |x - P(x - w / W)| with its diagonal element W, in m/s or rad/s.
  int iterations_used() const { return iterations_used_; }
  double residual() const { return residual_; }

  ContactMemory memory;

private:
  using Block = BlockSystem::Block;
  /// What a block is made of: a constraint, or a contact.
  struct Source
  {
    int constraint = -1, contact = -1;
    std::array<Movers::Place, 2> places{};
    int island = 0;
    int steps = 0; ///< To what nothing moves.
    int order = 0; ///< In which they came.

    bool joins_as(const Source& other) const { return places[0].mover == other.places[0].mover && places[1].mover == other.places[1].mover; }
  };
  /// Of a velocity, while positions change.
  struct Correction
  {
    double* velocity;
    double change, saved;
  };

  void find_sources();
  void find_islands();
  void find_steps();
  void place_velocities();
  void place_blocks();
  void fill(double time_step);
  Movers::Rows rows_of(const Block& block, std::size_t part, int first, int count);
  void fill_contact(const Block& block, const Source& source, double time_step);
  void fill_constraint(const Block& block, const Source& source, double time_step);
  void recall();
  void remember();
  void sweep(double time_step, double allowance);
  void calm();
  void apply(double time_step);
  void apply_contact(const Block& block, const Source& source, double time_step);
  void apply_wrench(Movers::Place place, dart::dynamics::BodyNode& body, const Eigen::Vector6d& wrench) const;
  void solve_island(const BlockSystem::Island& island, double time_step, Sweeps& sweeps, Swept& all);
  void keep_corrections();

  ContactReader reader_;
  std::vector<ContactTerms> contacts_;
  std::vector<dart::constraint::ConstraintBasePtr> constraints_;
  std::vector<engine::Rows> rows_; ///< Of the constraints.
  Movers movers_;
  std::vector<Source> sources_; ///< In the order of the blocks.
  std::vector<int> island_of_; ///< Of each mover.
  BlockSystem system_;
  std::vector<std::size_t> blocks_; ///< Of the sources in the order in which they came.
  std::vector<ContactMemory::Key> keys_; ///< In that order.
  Eigen::VectorXd corrected_;
  std::vector<Correction> corrections_;
  int iterations_used_ = 0;
  double residual_ = 0.0;
};

} // namespace pydart2
