#pragma once

#include <dart/collision/CollisionResult.hpp>
#include <dart/constraint/ConstraintBase.hpp>
#include <vector>

#include "base/lookup.hpp"
#include "contact/contact_terms.hpp"
#include "contact/skeleton_forest.hpp"
#include "engine/engine_access.hpp"

namespace pydart2 {

/// The contacts of rigid bodies as the exact solver needs them, with the bits of the engine's contact constraints and in the
/// order of its groups, without making either.
class DirectContacts
{
public:
  using Constraints = std::vector<dart::constraint::ConstraintBasePtr>;

  /// Reads those that the engine makes constraints of: shapes touch, and an impulse can move one of the bodies.
  void read(dart::collision::CollisionResult& result);

  /// Groups them, by what touches, with constraints of joints; false where the engine has a skeleton in two groups.
  bool group_with(const Constraints& constraints);

  /// In the order of their first members; each has the numbers of its contacts and, counted on, of its constraints.
  const std::vector<std::vector<std::size_t>>& groups() const { return groups_; }

  std::size_t size() const { return contacts_.size(); }
  std::size_t dimension(std::size_t contact) const { return contacts_[contact].terms.has_friction() ? 3 : 1; }

  /// Where impulses of a contact's rows act, and what these rows say.
  void read_rows(std::size_t contact, engine::Rows& rows, double time_step, const dart::constraint::ConstraintInfo& info);

  /// Stores the force that goes with a contact's impulses in it.
  void store_force(std::size_t contact, const double* impulses, double time_step) const;

  /// The engine's constraint in place of a contact.
  dart::constraint::ConstraintBasePtr make_constraint(std::size_t contact, double time_step) const;

private:
  struct Body
  {
    bool reactive;
    const dart::dynamics::Skeleton* skeleton;
    const Eigen::Isometry3d* pose;
    Eigen::Isometry3d inverse; ///< Of the pose.
    const Eigen::Vector6d* velocity;
  };

  struct Entry
  {
    ContactTerms terms;
    std::array<const Body*, 2> bodies;
    Eigen::Matrix<double, 3, 2> tangents;
  };

  const Body& look_at(const dart::dynamics::BodyNode& body);

  ContactReader reader_;
  std::vector<ContactTerms> terms_;
  std::vector<Entry> contacts_;
  Lookup<dart::dynamics::BodyNode, Body> bodies_;
  SkeletonForest forest_;
  Lookup<dart::dynamics::Skeleton, std::size_t> numbers_; ///< Of the groups, by their roots.
  std::vector<std::vector<std::size_t>> groups_;
};

} // namespace pydart2
