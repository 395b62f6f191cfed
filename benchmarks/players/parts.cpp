// parts STEPS SCENE... (as for loop_make): prints the seconds of CPU time of a step with DART's own constraint solver,
// those of them in the solver (from the constraint matrix to the impulses), those in the LCP, which is ours, and those in
// finding contacts, by FCL or the engine's own detector.

#include <chrono>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/external/odelcpsolver/common.h>
#include <iostream>
#include <memory>
#include <string>

#include "contact/dantzig_lcp.hpp"
#include "loop.hpp"

using dart::constraint::BoxedLcpConstraintSolver;

using Clock = std::chrono::steady_clock; // ten times as fast to read as the CPU time

static double since(Clock::time_point begin)
{
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class TimedLcp final : public dart::constraint::DantzigBoxedLcpSolver
{
public:
  double seconds = 0.0;

  bool solve(
      int n, double* A, double* x, double* b, int, double* lo, double* hi, int* findex, bool) override
  {
    using Vector = Eigen::Map<Eigen::VectorXd>;
    pydart2::DantzigLcp::Matrix matrix = Eigen::Map<pydart2::DantzigLcp::Matrix>(A, n, dPAD(n));
    Eigen::VectorXd solution(n), right = Vector(b, n), lower = Vector(lo, n), upper = Vector(hi, n);
    Eigen::VectorXi friction = Eigen::Map<Eigen::VectorXi>(findex, n);
    const auto begin = Clock::now();
    const bool solved = lcp_.solve(matrix, solution, right, lower, upper, friction);
    seconds += since(begin);
    Vector(x, n) = solution;
    return solved;
  }

private:
  pydart2::DantzigLcp lcp_;
};

class TimedSolver final : public BoxedLcpConstraintSolver
{
public:
  double seconds = 0.0;

protected:
  void solveConstrainedGroup(dart::constraint::ConstrainedGroup& group) override
  {
    const auto begin = Clock::now();
    BoxedLcpConstraintSolver::solveConstrainedGroup(group);
    seconds += since(begin);
  }
};

template <class Detector>
class Timed final : public Detector
{
public:
  explicit Timed(double& seconds) : seconds_(seconds) {}

  using Detector::collide;

  bool collide(
      dart::collision::CollisionGroup* group,
      const dart::collision::CollisionOption& option,
      dart::collision::CollisionResult* result) override
  {
    const auto begin = Clock::now();
    const bool any = Detector::collide(group, option, result);
    seconds_ += since(begin);
    return any;
  }

private:
  double& seconds_;
};

/// The same detector, which adds up the seconds of its searches; the given one if it is of another kind.
static dart::collision::CollisionDetectorPtr timed(const dart::collision::CollisionDetectorPtr& detector, double& seconds)
{
  using namespace dart::collision;
  if (const auto fcl = std::dynamic_pointer_cast<FCLCollisionDetector>(detector)) {
    const auto made = std::make_shared<Timed<FCLCollisionDetector>>(seconds);
    made->setPrimitiveShapeType(fcl->getPrimitiveShapeType());
    made->setContactPointComputationMethod(fcl->getContactPointComputationMethod());
    return made;
  }
  if (std::dynamic_pointer_cast<DARTCollisionDetector>(detector))
    return std::make_shared<Timed<DARTCollisionDetector>>(seconds);
  return detector;
}

int main(int argc, char** argv)
{
  if (argc < 3)
    return 1;
  const int steps = std::stoi(argv[1]);
  const std::unique_ptr<Loop> loop(loop_make(argc - 2, argv + 2));
  auto owned = std::make_unique<TimedSolver>();
  auto& solver = *owned;
  const auto lcp = std::make_shared<TimedLcp>();
  const auto detector = loop->world->getConstraintSolver()->getCollisionDetector();
  loop->world->setConstraintSolver(std::move(owned));
  double contacts = 0.0;
  solver.setCollisionDetector(timed(detector, contacts));
  solver.setBoxedLcpSolver(lcp);
  const auto begin = Clock::now();
  const double seconds = loop_steps(loop.get(), steps) / steps, share = seconds / since(begin);
  std::cout << seconds << " " << share * solver.seconds << " " << share * lcp->seconds << " " << share * contacts << "\n";
}
