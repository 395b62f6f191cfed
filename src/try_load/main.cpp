// Loads a model in a process of its own, where a crash of the engine's parsers does no harm, and simulates it a little.
// Reads "world" or "skeleton" and a packed ModelSource from standard input. Exit code 0: it works; 1: standard output
// says why not; a signal: the engine crashed, and an assertion that failed is on standard error.

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <iostream>
#include <memory>

#include "base/errors.hpp"
#include "base/messages.hpp"
#include "collision/detector.hpp"
#include "dynamics/weightless.hpp"
#include "engine/boxed_lcp.hpp"
#include "engine/shared_scenes.hpp"
#include "loading/loading.hpp"

namespace {

void limit(int resource, double most)
{
  const rlimit both{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
  setrlimit(resource, &both);
}

/// Stops at nothing that no solver of ours stops at.
class Solver final : public dart::constraint::BoxedLcpConstraintSolver
{
  void solveConstrainedGroup(dart::constraint::ConstrainedGroup& group) override
  {
    pydart2::remove_empty_constraints(group);
    BoxedLcpConstraintSolver::solveConstrainedGroup(group);
  }
};

/// What every user of a model does: its mass matrix, forces and, if it has the mass to move, one step.
void use(dart::simulation::World& world)
{
  bool moves = true;
  for (std::size_t i = 0; i < world.getNumSkeletons(); ++i) {
    moves = moves && pydart2::weightless_body(*world.getSkeleton(i)) == nullptr;
    world.getSkeleton(i)->getMassMatrix();
    world.getSkeleton(i)->getCoriolisAndGravityForces();
  }
  if (!moves)
    return;
  try {
    world.step();
  } catch (const pydart2::Error& error) {
    if (error.kind() != pydart2::Kind::engine) // of the matrix, which is the solver's and not the model's
      throw;
  }
}

} // namespace

int main(int argc, char* argv[])
{
  limit(RLIMIT_CORE, 0);
  if (argc > 1)
    limit(RLIMIT_CPU, std::atof(argv[1])); // seconds
  if (argc > 2)
    limit(RLIMIT_AS, std::atof(argv[2])); // bytes
  std::cout.rdbuf(std::cerr.rdbuf()); // standard output is for the answer
  pydart2::messages::install();
  const pydart2::messages::Listening listening;
  try {
    pydart2::share_scenes();
    std::string what;
    std::cin >> what;
    std::cin.get();
    const auto source = pydart2::unpack_source(std::cin);
    auto world = dart::simulation::World::create();
    if (what == "world")
      world = pydart2::load_world(source);
    else
      world->addSkeleton(pydart2::load_skeleton(source));
    pydart2::make_asymmetry_throw();
    world->setConstraintSolver(std::make_unique<Solver>());
    pydart2::replace_detector(*world->getConstraintSolver());
    use(*world);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stdout);
    return 1;
  }
  return 0;
}
