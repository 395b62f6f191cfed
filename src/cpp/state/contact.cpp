#include "state/contact.hpp"

#include <algorithm>
#include <dart/collision/CollisionObject.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <unordered_map>

#include "base/errors.hpp"
#include "state/collision_range.hpp"
#include "state/sleeping.hpp"
#include "state/step_plan.hpp"
#include "state/stepping.hpp"

namespace pydart2 {

namespace {

struct Side
{
  int skeleton = -1, body = -1, shape = -1;
};

int shape_index(const dart::dynamics::ShapeNode& node)
{
  const auto body = node.getBodyNodePtr();
  for (std::size_t i = 0; i < body->getNumShapeNodes(); ++i)
    if (body->getShapeNode(i) == &node)
      return static_cast<int>(i);
  return -1;
}

using Places = std::unordered_map<const dart::dynamics::Skeleton*, int>;

Side side(const Places& places, const dart::collision::CollisionObject& object)
{
  const auto* node = object.getShapeFrame()->asShapeNode();
  if (node == nullptr)
    return {}; // a SimpleFrame has no body
  const auto body = node->getBodyNodePtr();
  const auto found = places.find(body->getSkeleton().get());
  return {found == places.end() ? -1 : found->second, static_cast<int>(body->getIndexInSkeleton()), shape_index(*node)};
}

/// Whether it was kept when one of its bodies fell asleep; some detectors find it again.
bool is_of_sleeper(const WorldRecord& world, const dart::collision::Contact& contact)
{
  if (world.sleep.asleep.empty() || world.sleep.contacts_found)
    return false;
  for (const auto* object : {contact.collisionObject1, contact.collisionObject2})
    if (const auto* node = object->getShapeFrame()->asShapeNode())
      if (world.sleep.asleep.count(node->getBodyNodePtr()->getSkeleton().get()) > 0)
        return true;
  return false;
}

} // namespace

std::size_t num_contacts(const WorldRecord& world)
{
  const auto& found = world.world->getLastCollisionResult().getContacts();
  if (world.sleep.asleep.empty() || world.sleep.contacts_found)
    return found.size();
  return world.sleep.contacts.size()
         + static_cast<std::size_t>(std::count_if(
             found.begin(), found.end(), [&](const auto& contact) { return !is_of_sleeper(world, contact); }));
}

void write_contacts(const WorldRecord& world, double* out)
{
  Places places;
  for (const auto& item : world.skeletons)
    places.emplace(item->skeleton.get(), static_cast<int>(places.size()));
  const dart::collision::CollisionObject *object1 = nullptr, *object2 = nullptr; // contacts of a pair follow each other
  Side a, b;
  for (const auto& contact : world.world->getLastCollisionResult().getContacts()) {
    if (is_of_sleeper(world, contact))
      continue;
    if (contact.collisionObject1 != object1)
      a = side(places, *(object1 = contact.collisionObject1));
    if (contact.collisionObject2 != object2)
      b = side(places, *(object2 = contact.collisionObject2));
    const auto& p = contact.point;
    const auto& f = contact.force;
    const auto& n = contact.normal;
    const double row[contact_columns] = {
        p.x(), p.y(), p.z(), f.x(), f.y(), f.z(), double(a.skeleton), double(a.body), double(b.skeleton),
        double(b.body), double(a.shape), double(b.shape), n.x(), n.y(), n.z(), contact.penetrationDepth};
    out = std::copy(row, row + contact_columns, out);
  }
  if (!world.sleep.contacts_found)
    for (const auto& contact : world.sleep.contacts)
      out = std::copy(contact.row.begin(), contact.row.end(), out);
}

void forget_skeleton(double* row, int index)
{
  for (const int side : {0, 1}) {
    double &skeleton = row[6 + 2 * side], &body = row[7 + 2 * side], &shape = row[10 + side];
    if (skeleton == index)
      skeleton = body = shape = -1.0;
    else if (skeleton > index)
      --skeleton;
  }
}

void check_collision(WorldRecord& world)
{
  std::vector<Eigen::VectorXd> impulses;
  for (const auto& record : world.skeletons) {
    auto& skeleton = *record->skeleton;
    Eigen::VectorXd values(skeleton.getNumDofs());
    for (std::size_t i = 0; i < skeleton.getNumDofs(); ++i)
      values[i] = skeleton.getDof(i)->getConstraintImpulse();
    impulses.push_back(values);
    clear_impulses(skeleton);
    put_into_inertias(record->armature, skeleton);
  }
  const auto take_back = [&] {
    for (std::size_t s = 0; s < world.skeletons.size(); ++s) {
      auto& skeleton = *world.skeletons[s]->skeleton;
      clear_impulses(skeleton);
      for (std::size_t i = 0; i < skeleton.getNumDofs(); ++i)
        skeleton.getDof(i)->setConstraintImpulse(impulses[s][i]);
    }
  };
  const AllMobile for_now(world);
  plan_through_engine(world);
  try {
    for (const auto& record : world.skeletons)
      check_range(world, *record, world.world->getTime());
    solve_constraints(world, world.world->getTime());
    world.sleep.contacts_found = true;
  } catch (const Error& error) {
    take_back();
    world.world->getConstraintSolver()->clearLastCollisionResult(); // its forces may not be finite
    if (error.kind() != Kind::engine)
      throw;
    throw Error(Kind::simulation, std::string("the contact forces cannot be found: ") + error.what());
  }
  take_back();
}

} // namespace pydart2
