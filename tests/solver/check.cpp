// Steps scenes as the engine does and as this package does, with its fast constraint solver, its collision detectors and
// its dynamics, and compares them bit by bit.
//
//   check STEPS MODEL DETECTOR VARIATION [DETECTOR VARIATION ...]
//
// prints for each scene one line "DETECTOR VARIATION RESULT steps=N contacts=N rows=N difference=X skeletons=N", where RESULT is
//   equal     states, contacts and contact forces had the same bits in all steps, in each third one the poses, velocities,
//             accelerations and forces of all bodies, shapes and Jacobians too, and so had the constraint matrices; where
//             the engine's numbers grow until they are NaN, ours were NaN in the same places;
//   different they had not: N is the step;
//   varies    two worlds with the engine's own solver came to differ in step N, as happens with FCL; until then all was
//             equal;
//   refused   the engine cannot load the model or make its world;
//   engine    the engine's own solver ended the process in step N; until then all was equal;
//   ours      ours did.
// `difference` is the largest difference of an element of a constraint matrix, `rows` the size of the largest matrix,
// `skeletons` how many steps of skeletons were ours.
// Each scene runs in a process of its own, because the engine ends the process where an assertion of its fails.

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/PyramidShape.hpp>
#include <dart/external/odelcpsolver/common.h>
#include <iostream>

#include "collision/detector.hpp"
#include "contact/constraint_matrix.hpp"
#include "contact/fast_solver.hpp"
#include "dynamics/tree_dynamics.hpp"
#include "scenes.hpp"

using dart::constraint::ConstrainedGroup;
using dart::simulation::World;
using dart::simulation::WorldPtr;
using pydart2::ConstraintMatrix;

namespace {

struct Report
{
  char result[16] = "refused";
  int steps = 0;
  long contacts = 0;
  int rows = 0;
  long skeletons = 0;
  double difference = 0.0;
};

/// The engine's solver, which compares our matrix with its own in every group before it solves.
class ComparingSolver final : public dart::constraint::BoxedLcpConstraintSolver
{
public:
  explicit ComparingSolver(Report& report) : report_(report) {}

  void setFromOtherConstraintSolver(const ConstraintSolver& from) override
  {
    auto& other = const_cast<ConstraintSolver&>(from);
    mCollisionDetector = other.getCollisionDetector();
    mCollisionGroup = other.getCollisionGroup();
    mCollisionOption = other.getCollisionOption();
    mSkeletons = other.getSkeletons();
    mManualConstraints = other.getConstraints();
  }

protected:
  void solveConstrainedGroup(ConstrainedGroup& group) override
  {
    const int size = static_cast<int>(group.getTotalDimension());
    if (size == 0)
      return;
    const bool look = report_.steps < 50 || report_.steps % 10 == 0; // matrices by unit impulses take their time
    if (!look || is_shared(group)) {
      BoxedLcpConstraintSolver::solveConstrainedGroup(group);
      return;
    }
    ConstraintMatrix::Matrix ours(size, dPAD(size));
    matrix_.read(group, mSkeletons);
    matrix_.fill(&group, mTimeStep, ours);
    const auto theirs = engine_matrix(group, ours.cols());
    report_.rows = std::max(report_.rows, size);
    const double difference = (ours - theirs).cwiseAbs().maxCoeff();
    if (!(difference <= report_.difference)) // NaN too
      report_.difference = difference;
    BoxedLcpConstraintSolver::solveConstrainedGroup(group);
  }

private:
  /// Whether an earlier group of this step has acted on a skeleton of this one. Then what it has left there counts, and
  /// any other impulse would change the outcome.
  bool is_shared(ConstrainedGroup& group) const
  {
    std::vector<bool> before;
    for (const auto& skeleton : mSkeletons) {
      before.push_back(skeleton->isImpulseApplied());
      skeleton->setImpulseApplied(false);
    }
    for (std::size_t i = 0; i < group.getNumConstraints(); ++i)
      group.getConstraint(i)->excite();
    bool shared = false;
    for (std::size_t i = 0; i < mSkeletons.size(); ++i) {
      shared |= before[i] && mSkeletons[i]->isImpulseApplied();
      mSkeletons[i]->setImpulseApplied(before[i]);
    }
    return shared;
  }

  /// Unit impulses through the constraints' own functions.
  static ConstraintMatrix::Matrix engine_matrix(ConstrainedGroup& group, Eigen::Index columns)
  {
    ConstraintMatrix::Matrix A = ConstraintMatrix::Matrix::Zero(group.getTotalDimension(), columns);
    int begin = 0;
    for (std::size_t i = 0; i < group.getNumConstraints(); ++i) {
      auto& constraint = *group.getConstraint(i);
      const int end = begin + static_cast<int>(constraint.getDimension());
      constraint.excite();
      for (int row = begin; row < end; ++row) {
        constraint.applyUnitImpulse(row - begin);
        constraint.getVelocityChange(&A(row, begin), true);
        int column = end;
        for (std::size_t k = i + 1; k < group.getNumConstraints(); ++k) {
          group.getConstraint(k)->getVelocityChange(&A(row, column), false);
          column += static_cast<int>(group.getConstraint(k)->getDimension());
        }
        for (column = 0; column < begin; ++column)
          A(row, column) = A(column, row);
      }
      constraint.unexcite();
      begin = end;
    }
    return A;
  }

  Report& report_;
  ConstraintMatrix matrix_;
};

/// A world that steps as the package does, with its own dynamics where they cover a skeleton.
class Stepper
{
public:
  explicit Stepper(World& world) : world_(world)
  {
    for (std::size_t i = 0; i < world.getNumSkeletons(); ++i)
      dynamics_.push_back(pydart2::TreeDynamics::of(*world.getSkeleton(i)));
  }

  void step()
  {
    const double dt = world_.getTimeStep();
    std::vector<pydart2::TreeDynamics*> ours;
    for (std::size_t i = 0; i < dynamics_.size(); ++i) {
      auto& skeleton = *world_.getSkeleton(i);
      const bool taken = dynamics_[i] != nullptr && skeleton.isMobile() && !dynamics_[i]->is_for_engine();
      ours.push_back(taken ? dynamics_[i].get() : nullptr);
      if (taken) {
        ++skeletons;
        ours[i]->accelerate();
        ours[i]->integrate_velocities(dt);
      } else if (skeleton.isMobile()) {
        skeleton.computeForwardDynamics();
        skeleton.integrateVelocities(dt);
      }
    }
    solve();
    for (std::size_t i = 0; i < dynamics_.size(); ++i)
      if (world_.getSkeleton(i)->isMobile())
        finish(*world_.getSkeleton(i), ours[i], dt);
    world_.setTime(world_.getTime() + dt);
  }

  long skeletons = 0; ///< Steps of a skeleton that were ours.

private:
  void solve()
  {
    std::vector<dart::dynamics::SkeletonPtr> skeletons;
    bool rigid = true;
    for (std::size_t i = 0; i < world_.getNumSkeletons(); ++i) {
      const auto skeleton = world_.getSkeleton(i);
      skeleton->clearConstraintImpulses();
      skeleton->setImpulseApplied(false);
      rigid &= skeleton->getNumSoftBodyNodes() == 0;
      skeletons.push_back(skeleton);
    }
    pydart2::Jointed jointed;
    jointed.look_at(skeletons);
    pydart2::FreeBodies free;
    pydart2::fast_solver(world_).solve_step({skeletons, jointed, rigid, &free, false, nullptr});
  }

  static void finish(dart::dynamics::Skeleton& skeleton, pydart2::TreeDynamics* ours, double dt)
  {
    if (skeleton.isImpulseApplied()) {
      if (ours != nullptr)
        ours->apply_impulses();
      else
        skeleton.computeImpulseForwardDynamics();
      skeleton.setImpulseApplied(false);
    }
    if (ours != nullptr)
      ours->integrate_positions(dt);
    else
      skeleton.integratePositions(dt);
    skeleton.clearInternalForces();
    skeleton.clearExternalForces();
    skeleton.resetCommands();
  }

  World& world_;
  std::vector<std::unique_ptr<pydart2::TreeDynamics>> dynamics_;
};

template <class Numbers>
void add(std::vector<double>& to, const Numbers& numbers)
{
  to.insert(to.end(), numbers.data(), numbers.data() + numbers.size());
}

/// What the engine knows of a body beside the state, which it brings up to date where it is asked.
void add_body(std::vector<double>& to, const dart::dynamics::BodyNode& body)
{
  add(to, body.getWorldTransform().matrix());
  add(to, body.getSpatialVelocity());
  add(to, body.getSpatialAcceleration());
  add(to, body.getBodyForce());
  add(to, body.getJacobian());
  add(to, body.getJacobianSpatialDeriv());
  add(to, body.getParentJoint()->getBodyConstraintWrench());
  for (const auto* shape : body.getShapeNodes()) {
    add(to, shape->getWorldTransform().matrix());
    add(to, shape->getSpatialVelocity());
    add(to, shape->getSpatialAcceleration());
  }
}

/// Joint positions, velocities and forces; contact points, normals and forces; all of the bodies.
std::vector<double> outcome(const World& world, bool with_bodies)
{
  std::vector<double> numbers;
  for (std::size_t i = 0; i < world.getNumSkeletons(); ++i) {
    const auto skeleton = world.getSkeleton(i);
    add(numbers, skeleton->getPositions());
    add(numbers, skeleton->getVelocities());
    add(numbers, skeleton->getAccelerations());
    add(numbers, skeleton->getForces());
    if (!with_bodies)
      continue;
    for (const auto* body : skeleton->getBodyNodes())
      add_body(numbers, *body);
    add(numbers, skeleton->getMassMatrix());
    add(numbers, skeleton->getCoriolisAndGravityForces());
    add(numbers, skeleton->getInvAugMassMatrix());
  }
  for (const auto& contact : world.getLastCollisionResult().getContacts()) {
    add(numbers, contact.point);
    add(numbers, contact.normal);
    add(numbers, contact.force);
  }
  return numbers;
}

/// All bits but those of a NaN, whose sign depends on the order in which a compiler puts the operands of a sum.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b)
{
  const auto same = [](double x, double y) {
    return std::memcmp(&x, &y, sizeof(double)) == 0 || (std::isnan(x) && std::isnan(y));
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

/// Whether the engine's own detector with FCL puts one of its shapes anywhere.
bool has_cone_or_pyramid(const World& world)
{
  for (std::size_t i = 0; i < world.getNumSkeletons(); ++i)
    for (const auto* body : world.getSkeleton(i)->getBodyNodes())
      for (const auto* node : body->getShapeNodesWith<dart::dynamics::CollisionAspect>())
        if (node->getShape()->is<dart::dynamics::ConeShape>() || node->getShape()->is<dart::dynamics::PyramidShape>())
          return true;
  return false;
}

void run(int steps, const std::string& model, const std::string& detector, const std::string& variation, Report& report)
{
  const auto theirs = make_scene(model, detector, variation);
  const auto twin = make_scene(model, detector, variation);
  const auto ours = make_scene(model, detector, variation);
  const auto compared = make_scene(model, detector, variation);
  for (const auto& world : {theirs, twin, ours, compared})
    if (world == ours || (detector == "fcl" && has_cone_or_pyramid(*world))) {
      pydart2::replace_detector(*world->getConstraintSolver());
      pydart2::shape_choice(*world->getConstraintSolver()).engine_shapes = true;
    }
  pydart2::install_solver(*ours, pydart2::Solver::fast);
  compared->setConstraintSolver(std::make_unique<ComparingSolver>(report));
  Stepper stepper(*ours);
  for (report.steps = 0; report.steps < steps; ++report.steps) {
    for (const auto& world : {theirs, twin, ours, compared})
      command(*world, report.steps);
    std::strcpy(report.result, "engine");
    theirs->step();
    twin->step();
    const bool with_bodies = report.steps % 3 == 1; // what was asked for is not out of date in the next step
    const auto expected = outcome(*theirs, with_bodies);
    if (!same_bits(expected, outcome(*twin, with_bodies))) {
      std::strcpy(report.result, "varies");
      return;
    }
    std::strcpy(report.result, "ours");
    stepper.step();
    compared->step();
    std::strcpy(report.result, "different");
    if (!same_bits(expected, outcome(*ours, with_bodies)) || !same_bits(expected, outcome(*compared, with_bodies))
        || report.difference != 0.0)
      return;
    report.skeletons = stepper.skeletons;
    report.contacts += static_cast<long>(ours->getLastCollisionResult().getNumContacts());
  }
  std::strcpy(report.result, "equal");
}

} // namespace

int main(int count, char** arguments)
{
  if (count < 5 || count % 2 == 0) {
    std::cerr << "usage: check STEPS MODEL DETECTOR VARIATION [DETECTOR VARIATION ...]\n";
    return 2;
  }
  const int steps = std::stoi(arguments[1]);
  // Memory that outlives a child process that the engine ends.
  auto* report = static_cast<Report*>(
      mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  for (int i = 3; i < count; i += 2) {
    *report = Report();
    const pid_t child = fork();
    if (child == 0) {
      std::freopen("/dev/null", "w", stdout); // the engine's warnings
      std::freopen("/dev/null", "w", stderr);
      try {
        run(steps, arguments[2], arguments[i], arguments[i + 1], *report);
      } catch (const std::exception&) {
        std::_Exit(1);
      }
      std::_Exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    std::cout << arguments[i] << ' ' << arguments[i + 1] << ' ' << report->result << " steps=" << report->steps
              << " contacts=" << report->contacts << " rows=" << report->rows << " difference=" << report->difference
              << " skeletons=" << report->skeletons << std::endl;
  }
}
