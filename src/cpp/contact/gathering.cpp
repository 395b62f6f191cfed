#include <algorithm>
#include <dart/constraint/ContactConstraint.hpp>

#include "collision/native_detector.hpp"
#include "contact/contact_reduction.hpp"
#include "contact/fast_solver.hpp"
#include "engine/fixed_skins.hpp"
#include "engine/collision_filter.hpp"

/// What the iterative solver gets: contacts as the detector has them, and of the engine's constraints those that are not
/// contacts.
namespace pydart2 {

namespace {

using dart::collision::Contact;
using dart::constraint::ConstrainedGroup;
using dart::constraint::ConstraintBasePtr;
using dart::dynamics::Skeleton;

bool soft(const Skeleton& skeleton)
{
  return skeleton.getNumSoftBodyNodes() > 0; // their point masses move on their own
}

bool has_soft_body(const ConstraintBasePtr& constraint)
{
  engine::Rows rows;
  engine::read_rows(*constraint, rows);
  if (rows.kind == engine::Rows::Kind::joint)
    return soft(*rows.joint.joint->getSkeleton());
  const auto& bodies = rows.bodies.bodies;
  return std::any_of(bodies.begin(), bodies.end(), [](const auto* body) {
    return body != nullptr && soft(*body->getSkeleton());
  });
}

constexpr double touching = 1e-7; // m: a gap so narrow is none

} // namespace

void FastConstraintSolver::solve_by_sweeps(const Step& step)
{
  if (all_known())
    gather(step);
  else
    gather_from_groups(step);
  // The native detector has no more than four points of a pair of faces, and their depths are right.
  const bool native = mCollisionDetector->getType() == "native";
  iterative_.solve(mTimeStep, warm_start_, contact_reduction_ && !native, !native);
  if (native)
    drop_gaps();
}

bool FastConstraintSolver::all_known() const
{
  return std::none_of(mSkeletons.begin(), mSkeletons.end(), [](const auto& skeleton) { return soft(*skeleton); })
         && std::all_of(mManualConstraints.begin(), mManualConstraints.end(), [](const auto& constraint) {
              return IterativeSolver::knows(*constraint);
            });
}

/// Shapes that nearly touched and did not have not touched. Gaps by which bodies at rest hover are told as none.
void FastConstraintSolver::drop_gaps()
{
  auto& contacts = engine::contacts_of(mCollisionResult);
  const auto gap = [](const Contact& contact) { return contact.penetrationDepth < -touching && contact.force.isZero(0.0); };
  contacts.erase(std::remove_if(contacts.begin(), contacts.end(), gap), contacts.end());
  for (auto& contact : contacts)
    if (contact.penetrationDepth > -touching)
      contact.penetrationDepth = std::max(contact.penetrationDepth, 0.0);
}

/// With the native detector, the touches that the contacts are made of; else null.
const std::vector<native::Touch>* FastConstraintSolver::find_contacts(const Step& step)
{
  auto* group = dynamic_cast<NativeGroup*>(mCollisionGroup.get());
  if (group == nullptr || mCollisionOption.maxNumContacts == 0) {
    mCollisionResult.clear();
    mCollisionGroup->collide(mCollisionOption, &mCollisionResult);
    return nullptr;
  }
  if (!step.same)
    group->update();
  group->find(mCollisionOption, mTimeStep, mCollisionResult);
  return &group->touches();
}

/// The engine's updateConstraints() without its contact constraints.
void FastConstraintSolver::gather(const Step& step)
{
  clear_constraints();
  const auto take = [this](const ConstraintBasePtr& constraint) {
    constraint->update();
    scale_error(*constraint);
    if (constraint->isActive())
      iterative_.add(constraint);
  };
  const auto* touches = find_contacts(step);
  const bool woken = wake(step);
  if (woken)
    touches = find_contacts(step);
  for (const auto& constraint : mManualConstraints)
    take(constraint);
  for (std::size_t i = 0; i < mCollisionResult.getNumContacts(); ++i)
    if (auto& contact = mCollisionResult.getContact(i);
        !Contact::isZeroNormal(contact.normal) && (touches != nullptr || contact.penetrationDepth >= 0.0))
      iterative_.add(contact, touches == nullptr ? nullptr : &(*touches)[i]);
  if (woken)
    step.jointed.look_at(mSkeletons);
  for (const auto& constraint : step.jointed.make_constraints())
    take(constraint);
}

/// With the engine's constraints and groups, of which those with soft bodies or constraints of unknown kinds are solved
/// exactly, here and now.
void FastConstraintSolver::gather_from_groups(const Step& step)
{
  find_constraints(step);
  drop_fixed_skins(*this);
  buildConstrainedGroups();
  shared_ = mConstrainedGroups.size() > 1 && groups_share_skeletons();
  for (auto& group : mConstrainedGroups) {
    std::vector<ConstraintBasePtr> constraints;
    for (std::size_t i = 0; i < group.getNumConstraints(); ++i)
      constraints.push_back(group.getConstraint(i));
    const bool known = std::all_of(constraints.begin(), constraints.end(), [](const auto& constraint) {
      return IterativeSolver::knows(*constraint) && !has_soft_body(constraint);
    });
    if (!known || shared_) {
      if (contact_reduction_)
        keep_extremal_contacts(group);
      solve_exactly(group);
      continue;
    }
    for (const auto& constraint : constraints)
      if (const auto* contact = engine::contact(*constraint))
        iterative_.add(const_cast<Contact&>(*contact), nullptr); // the engine's result
      else {
        scale_error(*constraint);
        iterative_.add(constraint);
      }
  }
}

} // namespace pydart2
