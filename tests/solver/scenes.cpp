#include "scenes.hpp"

#include <dart/collision/bullet/BulletCollisionDetector.hpp>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/constraint/WeldJointConstraint.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/SoftBodyNode.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/utils/mjcf/MjcfParser.hpp>
#include <fstream>
#include <random>
#include <sstream>

#include "worlds.hpp"

using dart::dynamics::Joint;
using dart::simulation::World;

const std::vector<std::string> variations = {"plain", "joints", "surface", "joined", "pile"};

namespace {

using Random = std::mt19937;

double uniform(Random& random, double low, double high)
{
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

void set_detector(World& world, const std::string& name)
{
  auto& solver = *world.getConstraintSolver();
  if (name == "dart")
    solver.setCollisionDetector(dart::collision::DARTCollisionDetector::create());
  else if (name == "bullet")
    solver.setCollisionDetector(dart::collision::BulletCollisionDetector::create());
  else if (name == "ode")
    solver.setCollisionDetector(dart::collision::OdeCollisionDetector::create());
  else
    solver.setCollisionDetector(dart::collision::FCLCollisionDetector::create());
}

/// A box with shape and mass as the child of `joint`'s kind.
template <class JointType>
BodyNode* add_box(SkeletonPtr skeleton, BodyNode* parent, const Eigen::Vector3d& size)
{
  auto pair = skeleton->createJointAndBodyNodePair<JointType>(parent);
  auto shape = std::make_shared<dart::dynamics::BoxShape>(size);
  pair.second->template createShapeNodeWith<
      dart::dynamics::VisualAspect, dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(shape);
  dart::dynamics::Inertia inertia(1.0, Eigen::Vector3d::Zero(), shape->computeInertia(1.0));
  pair.second->setInertia(inertia);
  return pair.second;
}

/// Worlds in SDF and MJCF files too.
WorldPtr load_any(const std::string& model)
{
  const auto retriever = std::make_shared<dart::common::LocalResourceRetriever>();
  const auto uri = dart::common::Uri::createFromPath(model);
  std::stringstream content;
  content << std::ifstream(model).rdbuf();
  WorldPtr world;
  if (model.find(".xml") != std::string::npos)
    world = dart::utils::MjcfParser::readWorld(uri, dart::utils::MjcfParser::Options(retriever));
  else if (content.str().find("<world") != std::string::npos && model.find(".sdf") != std::string::npos)
    world = dart::utils::SdfParser::readWorld(uri, dart::utils::SdfParser::Options(retriever));
  else
    world = load(model);
  if (world == nullptr)
    throw std::invalid_argument("the engine could not load " + model);
  return world;
}

/// The lowest corner along y of the bounding boxes of what can move.
double lowest(World& world)
{
  double y = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < world.getNumSkeletons(); ++i)
    for (auto* body : world.getSkeleton(i)->getBodyNodes())
      for (const auto* node : body->getShapeNodesWith<dart::dynamics::CollisionAspect>()) {
        if (!body->isReactive())
          continue;
        const auto& box = node->getShape()->getBoundingBox();
        const Eigen::Vector3d half = 0.5 * (box.getMax() - box.getMin());
        const auto& T = node->getWorldTransform();
        const Eigen::Vector3d center = T * (0.5 * (box.getMax() + box.getMin()));
        y = std::min(y, center.y() - T.linear().row(1).cwiseAbs().dot(half));
      }
  return std::isfinite(y) ? y : 0.0;
}

void add_floor(World& world)
{
  const double top = lowest(world) + 0.002;
  auto floor = dart::dynamics::Skeleton::create("floor of the comparison");
  auto* body = add_box<dart::dynamics::WeldJoint>(floor, nullptr, Eigen::Vector3d(20.0, 0.2, 20.0));
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().y() = top - 0.1;
  body->getParentJoint()->setTransformFromParentBodyNode(T);
  floor->setMobile(false);
  world.addSkeleton(floor);
}

void scatter(World& world, Random& random)
{
  for (std::size_t i = 0; i < world.getNumSkeletons(); ++i)
    for (auto* dof : world.getSkeleton(i)->getDofs()) {
      dof->setPosition(dof->getPosition() + uniform(random, -0.02, 0.02));
      dof->setVelocity(dof->getVelocity() + uniform(random, -0.3, 0.3));
    }
}

void vary_joints(World& world, Random& random)
{
  const Joint::ActuatorType kinds[]
      = {Joint::FORCE, Joint::SERVO, Joint::PASSIVE, Joint::VELOCITY, Joint::FORCE, Joint::ACCELERATION,
         Joint::SERVO, Joint::LOCKED};
  int count = 0;
  for (std::size_t s = 0; s < world.getNumSkeletons(); ++s)
    for (auto* body : world.getSkeleton(s)->getBodyNodes()) {
      auto* joint = body->getParentJoint();
      if (joint->getNumDofs() == 0)
        continue;
      const bool root = body->getParentBodyNode() == nullptr;
      const int index = count++;
      if (!root)
        joint->setActuatorType(kinds[index % 8]);
      if (index % 3 != 1)
        joint->setLimitEnforcement(true);
      for (std::size_t i = 0; i < joint->getNumDofs(); ++i) {
        auto* dof = joint->getDof(i);
        if (!root || index % 2 == 0) {
          const double q = dof->getPosition();
          dof->setPositionLimits(q - uniform(random, 0, 0.05), q + uniform(random, 0, 0.05));
          dof->setVelocityLimits(-1.0, 1.0);
        }
        dof->setForceLimits(-50.0, 50.0);
        if (index % 4 < 2)
          dof->setCoulombFriction(uniform(random, 0.1, 1.0));
        if (index % 5 < 3)
          dof->setDampingCoefficient(uniform(random, 0.01, 0.5));
        if (index % 5 == 1) {
          dof->setSpringStiffness(uniform(random, 1.0, 10.0));
          dof->setRestPosition(dof->getPosition() + 0.1);
        }
      }
    }
}

void vary_surfaces(World& world)
{
  int count = 0;
  for (std::size_t s = 0; s < world.getNumSkeletons(); ++s) {
    auto& skeleton = *world.getSkeleton(s);
    skeleton.enableSelfCollisionCheck();
    skeleton.setAdjacentBodyCheck(false);
    for (auto* body : skeleton.getBodyNodes())
      for (auto* node : body->getShapeNodesWith<dart::dynamics::DynamicsAspect>()) {
        auto* dynamics = node->getDynamicsAspect();
        const int index = count++;
        dynamics->setRestitutionCoeff(index % 2 == 0 ? 0.9 : 0.7);
        if (index % 5 == 4)
          dynamics->setFrictionCoeff(0.0);
        if (index % 3 == 1) {
          dynamics->setPrimarySlipCompliance(0.02);
          dynamics->setSecondarySlipCompliance(0.05);
        }
      }
  }
}

void join(World& world)
{
  std::vector<BodyNode*> bodies;
  for (std::size_t s = 0; s < world.getNumSkeletons(); ++s)
    for (auto* body : world.getSkeleton(s)->getBodyNodes())
      if (bodies.size() < 400)
        bodies.push_back(body);
  auto& solver = *world.getConstraintSolver();
  using namespace dart::constraint;
  for (std::size_t i = 0, made = 0; i + 1 < bodies.size() && made < 6; i += 2) {
    auto *one = bodies[i], *two = bodies[bodies.size() - 1 - i / 2];
    if (one == two || !(one->isReactive() || two->isReactive()))
      continue;
    if (made % 3 == 0)
      solver.addConstraint(std::make_shared<WeldJointConstraint>(one, two));
    else if (made % 3 == 1)
      solver.addConstraint(std::make_shared<BallJointConstraint>(one, two, two->getCOM()));
    else if (one->isReactive())
      solver.addConstraint(std::make_shared<BallJointConstraint>(one, one->getCOM()));
    ++made;
  }
  // Every third joint with one degree of freedom follows the one before.
  Joint* reference = nullptr;
  for (std::size_t i = 0, count = 0; i < bodies.size(); ++i) {
    auto* joint = bodies[i]->getParentJoint();
    if (joint->getNumDofs() != 1 || !bodies[i]->isReactive())
      continue;
    if (reference != nullptr && count++ % 3 == 2 && reference->getSkeleton() == joint->getSkeleton()) {
      joint->setActuatorType(Joint::MIMIC);
      joint->setMimicJoint(reference, -0.5, 0.01);
      joint->getDof(0)->setForceLimits(-100.0, 100.0);
    }
    reference = joint;
  }
}

/// Where a pile stands: on the first soft body, else away from all else on the floor.
Eigen::Vector3d pile_ground(World& world)
{
  for (std::size_t s = 0; s < world.getNumSkeletons(); ++s)
    if (world.getSkeleton(s)->getNumSoftBodyNodes() > 0)
      return world.getSkeleton(s)->getSoftBodyNode(0)->getCOM() + Eigen::Vector3d(0.0, 0.1, 0.0);
  return {5.0, lowest(world), 5.0};
}

/// Pairs of jointed boxes, one pair over the other: contacts join their skeletons one after the other.
void add_pile(World& world, Random& random)
{
  const Eigen::Vector3d ground = pile_ground(world);
  for (int i = 0; i < 4; ++i) {
    auto skeleton = dart::dynamics::Skeleton::create("pile " + std::to_string(i));
    auto* lower = add_box<dart::dynamics::FreeJoint>(skeleton, nullptr, Eigen::Vector3d(0.3, 0.1, 0.3));
    auto* upper = add_box<dart::dynamics::RevoluteJoint>(skeleton, lower, Eigen::Vector3d(0.1, 0.1, 0.1));
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().x() = 0.25;
    upper->getParentJoint()->setTransformFromParentBodyNode(T);
    upper->getParentJoint()->setLimitEnforcement(true);
    upper->getParentJoint()->getDof(0)->setPositionLimits(-0.01, 0.01);
    upper->getParentJoint()->getDof(0)->setCoulombFriction(0.05);
    T.translation() = ground + Eigen::Vector3d(0.0, 0.051 + 0.1 * i, uniform(random, -0.1, 0.1));
    dart::dynamics::FreeJoint::setTransform(lower, T);
    world.addSkeleton(skeleton);
  }
}

} // namespace

dart::simulation::WorldPtr make_scene(
    const std::string& model, const std::string& detector, const std::string& variation)
{
  Random random(7);
  auto world = load_any(model);
  set_detector(*world, detector);
  if (variation != "plain" || world->getNumSkeletons() == 1)
    add_floor(*world);
  if (variation == "joints")
    vary_joints(*world, random);
  else if (variation == "surface")
    vary_surfaces(*world);
  else if (variation == "joined")
    join(*world);
  else if (variation == "pile")
    add_pile(*world, random);
  scatter(*world, random);
  return world;
}

void command(World& world, int step)
{
  int count = 0;
  for (std::size_t s = 0; s < world.getNumSkeletons(); ++s)
    for (auto* dof : world.getSkeleton(s)->getDofs()) {
      const int index = count++;
      const auto kind = dof->getJoint()->getActuatorType();
      if (kind == Joint::SERVO || kind == Joint::VELOCITY || kind == Joint::ACCELERATION)
        dof->setCommand(0.3 * std::sin(0.01 * step + index));
    }
}
