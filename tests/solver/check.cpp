// Steps scenes as the engine does and as this package does, with its fast constraint solver and its collision detectors,
// and compares them bit by bit.
//
//   check STEPS MODEL DETECTOR VARIATION [DETECTOR VARIATION ...]
//
// prints for each scene one line "DETECTOR VARIATION RESULT steps=N contacts=N rows=N difference=X", where RESULT is
//   equal     states, contacts and contact forces had the same bits in all steps, and so had the constraint matrices;
//   different they had not: N is the step;
//   varies    two worlds with the engine's own solver came to differ in step N, as happens with FCL; until then all was
//             equal;
//   refused   the engine cannot load the model or make its world;
//   engine    the engine's own solver ended the process in step N; until then all was equal;
//   ours      ours did.
// `difference` is the largest difference of an element of a constraint matrix, `rows` the size of the largest matrix.
// Each scene runs in a process of its own, because the engine ends the process where an assertion of its fails.

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/dynamics/ConeShape.hpp>
#include <dart/dynamics/PyramidShape.hpp>
#include <dart/external/odelcpsolver/common.h>
#include <iostream>

#include "collision/detector.hpp"
#include "contact/constraint_matrix.hpp"
#include "contact/fast_solver.hpp"
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
    matrix_.fill(group, mTimeStep, ours);
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

/// Joint positions, velocities and forces; contact points, normals and forces.
std::vector<double> outcome(const World& world)
{
  std::vector<double> numbers;
  const auto add = [&](const Eigen::VectorXd& v) { numbers.insert(numbers.end(), v.data(), v.data() + v.size()); };
  for (std::size_t i = 0; i < world.getNumSkeletons(); ++i) {
    const auto skeleton = world.getSkeleton(i);
    add(skeleton->getPositions());
    add(skeleton->getVelocities());
    add(skeleton->getAccelerations());
    add(skeleton->getForces());
  }
  for (const auto& contact : world.getLastCollisionResult().getContacts()) {
    add(contact.point);
    add(contact.normal);
    add(contact.force);
  }
  return numbers;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
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
    if (world == ours || (detector == "fcl" && has_cone_or_pyramid(*world)))
      pydart2::replace_detector(*world->getConstraintSolver());
  pydart2::install_solver(*ours, pydart2::Solver::fast);
  compared->setConstraintSolver(std::make_unique<ComparingSolver>(report));
  for (report.steps = 0; report.steps < steps; ++report.steps) {
    for (const auto& world : {theirs, twin, ours, compared})
      command(*world, report.steps);
    std::strcpy(report.result, "engine");
    theirs->step();
    twin->step();
    const auto expected = outcome(*theirs);
    if (!same_bits(expected, outcome(*twin))) {
      std::strcpy(report.result, "varies");
      return;
    }
    std::strcpy(report.result, "ours");
    ours->step();
    compared->step();
    std::strcpy(report.result, "different");
    if (!same_bits(expected, outcome(*ours)) || !same_bits(expected, outcome(*compared)) || report.difference != 0.0)
      return;
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
              << std::endl;
  }
}
