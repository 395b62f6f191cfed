// What Debian's Python binding of DART cannot say, as JSON on stdout. See `usage` for the questions.
//
// Every question takes a model FILE: .skel gives a world; .sdf, .urdf and .vsk give a skeleton in an empty world with
// gravity (0, -9.81, 0). On stdin: nothing, or q and then dq of every skeleton of the world, in order, as plain
// numbers. STEPS are done after that. SI units; positions in world coordinates unless a name says local, resting or q.

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/CollisionResult.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/Joint.hpp>
#include <dart/dynamics/Marker.hpp>
#include <dart/dynamics/PointMass.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SoftBodyNode.hpp>
#include <dart/simulation/World.hpp>

#include "json.hpp"
#include "worlds.hpp"

using Arguments = std::vector<std::string>;

const char* const usage = R"(usage: oracle QUESTION FILE ...
  dynamics FILE STEPS                   q dq M c C T of every skeleton, and the time
  markers  FILE                         name, body, local and world position of every marker
  soft     FILE STEPS                   point masses and faces of every soft body
  vsk      FILE                         bodies, joints, dofs, masses, q and M of the skeleton
  filter   FILE STEPS SKEL1 BODY1 SKEL2 BODY2
                                        contacts of the last step, with the pair allowed and blacklisted
  mimic    FILE STEPS SKEL JOINT REFERENCE MULTIPLIER OFFSET
                                        q and dq (STEPS + 1 rows) of SKEL while JOINT mimics REFERENCE
Skeletons, bodies and joints are given by index.
)";

std::string dynamics(const Arguments& a)
{
  const WorldPtr world = prepare(a[0]);
  stepTimes(world, a[1]);
  std::vector<std::string> skeletons;
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i) {
    const SkeletonPtr s = world->getSkeleton(i);
    std::vector<std::string> transforms;
    for (const BodyNode* body : s->getBodyNodes())
      transforms.push_back(array(body->getWorldTransform().matrix()));
    skeletons.push_back(object({{"name", text(s->getName())}, {"q", array(s->getPositions())},
                                {"dq", array(s->getVelocities())}, {"M", array(s->getMassMatrix())},
                                {"c", array(s->getCoriolisAndGravityForces())}, {"C", array(s->getCOM())},
                                {"T", list(transforms)}}));
  }
  return object({{"time", number(world->getTime())}, {"skeletons", list(skeletons)}});
}

std::string markersOf(const SkeletonPtr& skeleton)
{
  std::vector<std::string> markers;
  for (const BodyNode* body : skeleton->getBodyNodes())
    for (std::size_t i = 0; i < body->getNumMarkers(); ++i) {
      const dart::dynamics::Marker* m = body->getMarker(i);
      markers.push_back(object({{"name", text(m->getName())}, {"body", text(body->getName())},
                                {"local", array(m->getLocalPosition())}, {"world", array(m->getWorldPosition())}}));
    }
  return list(markers);
}

std::string markers(const Arguments& a)
{
  const WorldPtr world = prepare(a[0]);
  std::vector<std::string> skeletons;
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i)
    skeletons.push_back(object(
        {{"name", text(world->getSkeleton(i)->getName())}, {"markers", markersOf(world->getSkeleton(i))}}));
  return object({{"skeletons", list(skeletons)}});
}

std::string softBody(const dart::dynamics::SoftBodyNode& body)
{
  const std::size_t count = body.getNumPointMasses();
  Eigen::MatrixXd q(count, 3), dq(count, 3), local(count, 3), world(count, 3), resting(count, 3);
  Eigen::VectorXd mass(count);
  for (std::size_t i = 0; i < count; ++i) {
    const dart::dynamics::PointMass* point = body.getPointMass(i);
    q.row(i) = point->getPositions();
    dq.row(i) = point->getVelocities();
    resting.row(i) = point->getRestingPosition();
    local.row(i) = point->getLocalPosition();
    world.row(i) = point->getWorldPosition();
    mass[i] = point->getMass();
  }
  Eigen::MatrixXi faces(body.getNumFaces(), 3);
  for (std::size_t i = 0; i < body.getNumFaces(); ++i)
    faces.row(i) = body.getFace(i);
  return object({{"body", text(body.getName())}, {"q", array(q)}, {"dq", array(dq)}, {"resting", array(resting)},
                 {"local", array(local)}, {"world", array(world)}, {"mass", array(mass)},
                 {"body_mass", number(body.getMass())}, {"faces", array(faces)}});
}

std::string soft(const Arguments& a)
{
  const WorldPtr world = prepare(a[0]);
  stepTimes(world, a[1]);
  std::vector<std::string> skeletons;
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i) {
    const SkeletonPtr s = world->getSkeleton(i);
    std::vector<std::string> bodies;
    for (std::size_t j = 0; j < s->getNumSoftBodyNodes(); ++j)
      bodies.push_back(softBody(*s->getSoftBodyNode(j)));
    skeletons.push_back(object({{"name", text(s->getName())}, {"q", array(s->getPositions())},
                                {"dq", array(s->getVelocities())}, {"soft_bodies", list(bodies)}}));
  }
  return object({{"time", number(world->getTime())}, {"skeletons", list(skeletons)}});
}

std::string vsk(const Arguments& a)
{
  const WorldPtr world = prepare(a[0]);
  const SkeletonPtr s = world->getSkeleton(0);
  std::vector<std::string> bodies, joints, dofs;
  for (const BodyNode* body : s->getBodyNodes()) {
    const BodyNode* parent = body->getParentBodyNode();
    const dart::dynamics::Joint* joint = body->getParentJoint();
    bodies.push_back(object({{"name", text(body->getName())}, {"mass", number(body->getMass())},
                             {"parent", parent ? text(parent->getName()) : "null"}}));
    joints.push_back(object({{"name", text(joint->getName())}, {"type", text(joint->getType())}}));
  }
  for (const dart::dynamics::DegreeOfFreedom* dof : s->getDofs())
    dofs.push_back(text(dof->getName()));
  return object({{"name", text(s->getName())}, {"mass", number(s->getMass())}, {"bodies", list(bodies)},
                 {"joints", list(joints)}, {"dofs", list(dofs)}, {"markers", markersOf(s)},
                 {"q", array(s->getPositions())}, {"M", array(s->getMassMatrix())}});
}

std::string contactsOf(const WorldPtr& world)
{
  std::map<const dart::dynamics::Skeleton*, int> ids;
  for (std::size_t i = 0; i < world->getNumSkeletons(); ++i)
    ids[world->getSkeleton(i).get()] = i;
  const auto& contacts = world->getLastCollisionResult().getContacts();
  Eigen::MatrixXd points(contacts.size(), 3), forces(contacts.size(), 3);
  Eigen::MatrixXi bodies(contacts.size(), 4);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    points.row(i) = contacts[i].point;
    forces.row(i) = contacts[i].force;
    const BodyNode* one = contacts[i].collisionObject1->getShapeFrame()->asShapeNode()->getBodyNodePtr();
    const BodyNode* two = contacts[i].collisionObject2->getShapeFrame()->asShapeNode()->getBodyNodePtr();
    bodies.row(i) << ids[one->getSkeleton().get()], one->getIndexInSkeleton(), ids[two->getSkeleton().get()],
        two->getIndexInSkeleton();
  }
  return object({{"point", array(points)}, {"force", array(forces)}, {"bodies", array(bodies)}});
}

std::string filter(const Arguments& a)
{
  const auto contacts = [&](bool blacklisted) {
    const WorldPtr world = prepare(a[0]);
    auto pairs = std::make_shared<dart::collision::BodyNodeCollisionFilter>();
    if (blacklisted)
      pairs->addBodyNodePairToBlackList(
          bodyAt(skeletonAt(world, a[2]), a[3]), bodyAt(skeletonAt(world, a[4]), a[5]));
    world->getConstraintSolver()->getCollisionOption().collisionFilter = pairs;
    stepTimes(world, a[1]);
    return contactsOf(world);
  };
  return object({{"allowed", contacts(false)}, {"blacklisted", contacts(true)}});
}

std::string mimic(const Arguments& a)
{
  const WorldPtr world = prepare(a[0]);
  const SkeletonPtr skeleton = skeletonAt(world, a[2]);
  dart::dynamics::Joint* joint = bodyAt(skeleton, a[3])->getParentJoint();
  joint->setActuatorType(dart::dynamics::Joint::MIMIC);
  joint->setMimicJoint(bodyAt(skeleton, a[4])->getParentJoint(), std::stod(a[5]), std::stod(a[6]));
  const int steps = std::stoi(a[1]);
  Eigen::MatrixXd q(steps + 1, skeleton->getNumDofs()), dq = q;
  for (int i = 0; i <= steps; ++i) {
    if (i > 0)
      world->step();
    q.row(i) = skeleton->getPositions();
    dq.row(i) = skeleton->getVelocities();
  }
  return object({{"q", array(q)}, {"dq", array(dq)}});
}

int main(int argc, char** argv)
{
  const std::map<std::string, std::pair<std::size_t, std::function<std::string(const Arguments&)>>> questions{
      {"dynamics", {2, dynamics}}, {"markers", {1, markers}}, {"soft", {2, soft}},
      {"vsk", {1, vsk}}, {"filter", {6, filter}}, {"mimic", {7, mimic}}};
  const Arguments arguments(argv + std::min(argc, 2), argv + argc);
  const auto question = questions.find(argc > 1 ? argv[1] : "");
  if (question == questions.end() || question->second.first != arguments.size()) {
    std::cerr << usage;
    return 2;
  }
  std::streambuf* answers = std::cout.rdbuf(std::cerr.rdbuf());  // the engine prints to cout too
  try {
    const std::string answer = question->second.second(arguments);
    std::ostream(answers) << answer << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "oracle: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
