#include "state/contact.hpp"

#include <algorithm>
#include <dart/collision/CollisionObject.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/ShapeNode.hpp>

#include "base/errors.hpp"
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

Side side(const WorldRecord& world, const dart::collision::CollisionObject& object)
{
  const auto* node = object.getShapeFrame()->asShapeNode();
  if (node == nullptr)
    return {}; // a SimpleFrame has no body
  const auto body = node->getBodyNodePtr();
  return {world.index_of(body->getSkeleton()), static_cast<int>(body->getIndexInSkeleton()), shape_index(*node)};
}

} // namespace

std::size_t num_contacts(const WorldRecord& world)
{
  return world.world->getLastCollisionResult().getNumContacts();
}

void write_contacts(const WorldRecord& world, double* out)
{
  const dart::collision::CollisionObject *object1 = nullptr, *object2 = nullptr; // contacts of a pair follow each other
  Side a, b;
  for (const auto& contact : world.world->getLastCollisionResult().getContacts()) {
    if (contact.collisionObject1 != object1)
      a = side(world, *(object1 = contact.collisionObject1));
    if (contact.collisionObject2 != object2)
      b = side(world, *(object2 = contact.collisionObject2));
    const auto& p = contact.point;
    const auto& f = contact.force;
    const auto& n = contact.normal;
    const double row[contact_columns] = {
        p.x(), p.y(), p.z(), f.x(), f.y(), f.z(), double(a.skeleton), double(a.body), double(b.skeleton),
        double(b.body), double(a.shape), double(b.shape), n.x(), n.y(), n.z(), contact.penetrationDepth};
    out = std::copy(row, row + contact_columns, out);
  }
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
  }
  const auto take_back = [&] {
    for (std::size_t s = 0; s < world.skeletons.size(); ++s) {
      auto& skeleton = *world.skeletons[s]->skeleton;
      skeleton.clearConstraintImpulses();
      skeleton.setImpulseApplied(false);
      for (std::size_t i = 0; i < skeleton.getNumDofs(); ++i)
        skeleton.getDof(i)->setConstraintImpulse(impulses[s][i]);
    }
  };
  try {
    solve_constraints(world, world.world->getTime());
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
