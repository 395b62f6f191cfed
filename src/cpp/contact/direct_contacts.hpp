#pragma once

#include <dart/collision/CollisionResult.hpp>
#include <unordered_map>
#include <vector>

#include "contact/contact_terms.hpp"
#include "engine/engine_access.hpp"

namespace pydart2 {

/// The contacts of rigid bodies as the exact solver needs them, with the bits of the engine's contact constraints and in the
/// order of its groups, without making either.
class DirectContacts
{
public:
  struct Row
  {
    double b, lo, hi;
    bool friction; ///< Its bounds are parts of the impulse of the contact's first row.
  };

  /// Reads those that the engine makes constraints of: shapes touch, and an impulse can move one of the bodies.
  void read(dart::collision::CollisionResult& result);

  /// Of bodies that touch, in the order of their first contacts; each has the numbers of its contacts.
  const std::vector<std::vector<int>>& groups();

  int dimension(int contact) const { return at(contact).terms.has_friction() ? 3 : 1; }

  /// Where impulses of a contact's rows act, and what these rows say.
  void read_rows(int contact, engine::Rows& rows, double time_step, Row* out);

  /// Stores the force that goes with a contact's impulses in it.
  void store_force(int contact, const double* impulses, double time_step) const;

private:
  struct Body
  {
    bool reactive;
    const dart::dynamics::Skeleton* skeleton;
    Eigen::Isometry3d inverse;
  };

  struct Entry
  {
    ContactTerms terms;
    std::array<const Body*, 2> bodies;
    Eigen::Matrix<double, 3, 2> tangents;
  };

  Entry& at(int contact) { return contacts_[static_cast<std::size_t>(contact)]; }
  const Entry& at(int contact) const { return contacts_[static_cast<std::size_t>(contact)]; }
  const Body& look_at(const dart::dynamics::BodyNode& body);
  const dart::dynamics::Skeleton* root(const dart::dynamics::Skeleton* skeleton);

  ContactReader reader_;
  std::vector<ContactTerms> terms_;
  std::vector<Entry> contacts_;
  std::unordered_map<const dart::dynamics::BodyNode*, Body> bodies_;
  std::unordered_map<const dart::dynamics::Skeleton*, const dart::dynamics::Skeleton*> united_;
  std::vector<std::vector<int>> groups_;
};

} // namespace pydart2
