// Loads models in processes of their own, where a crash of the engine's parsers does no harm, and simulates each a little.
//
// It lives as long as its standard input is open, and forks one process for each request: loading the engine's libraries,
// which takes most of a trial, is done once. It knows no models itself, so that each trial begins as the first.
//
// A request: seconds of processor time, bytes of memory, bytes of what follows, in a line; then "world" or "skeleton" and
// a packed ModelSource, or what MuJoCo compiles (mjcf.hpp). An answer: exit code, or minus a signal's number, and the bytes of two texts, in a line; the
// texts. Code 0: it works; 1: the first text says why not; a signal: the engine crashed, and an assertion that failed is
// in the second.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <iostream>
#include <memory>
#include <sstream>

#include "base/errors.hpp"
#include "base/messages.hpp"
#include "collision/detector.hpp"
#include "dynamics/weightless.hpp"
#include "engine/boxed_lcp.hpp"
#include "engine/shared_scenes.hpp"
#include "loading/loading.hpp"
#include "mjcf.hpp"

namespace {

constexpr double most_said = 1e6; // bytes of each text

struct Request
{
  double seconds = 0.0, bytes = 0.0;
  std::string model;
};

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

/// Gives a world the solver and the detector of a trial.
void prepare(dart::simulation::World& world)
{
  pydart2::make_asymmetry_throw();
  world.setConstraintSolver(std::make_unique<Solver>());
  pydart2::replace_detector(*world.getConstraintSolver());
}

/// Loads and uses a model; the exit code.
int attempt(const std::string& model)
{
  const pydart2::messages::Listening listening;
  try {
    std::istringstream in(model);
    std::string what;
    in >> what;
    in.get();
    const auto source = pydart2::unpack_source(in);
    auto world = what == "world" ? pydart2::load_world(source) : dart::simulation::World::create();
    prepare(*world);
    if (what != "world") // now, when its meshes get one tree each
      world->addSkeleton(pydart2::load_skeleton(source));
    use(*world);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stdout);
    return 1;
  }
  return 0;
}

/// In the process of one trial, which ends in it.
[[noreturn]] void run(const Request& request, int said, int complained)
{
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(said, STDOUT_FILENO);
  dup2(complained, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, most_said);
  limit(RLIMIT_CPU, request.seconds);
  limit(RLIMIT_AS, request.bytes);
  const int code = mjcf::is_request(request.model) ? mjcf::compile(request.model) : attempt(request.model);
  std::fflush(nullptr);
  std::cerr.flush();
  _exit(code);
}

std::string content(int file)
{
  std::string text(static_cast<std::size_t>(lseek(file, 0, SEEK_END)), '\0');
  const auto count = pread(file, text.data(), text.size(), 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  close(file);
  return text;
}

bool read(Request& request)
{
  std::size_t size = 0;
  std::cin >> request.seconds >> request.bytes >> size;
  std::cin.get();
  if (!std::cin)
    return false;
  request.model.resize(size);
  return bool(std::cin.read(request.model.data(), static_cast<std::streamsize>(size)));
}

void answer(const Request& request)
{
  if (mjcf::is_request(request.model))
    mjcf::open_libraries(request.model);
  const int said = memfd_create("said", 0), complained = memfd_create("complained", 0);
  const pid_t child = fork();
  if (child == 0)
    run(request, said, complained);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child)
    status = 1 << 8;
  const std::string reason = child < 0 ? "there is no room for another process" : content(said), rest = content(complained);
  std::printf("%d %zu %zu\n", WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status), reason.size(), rest.size());
  std::fwrite(reason.data(), 1, reason.size(), stdout);
  std::fwrite(rest.data(), 1, rest.size(), stdout);
  std::fflush(stdout);
}

} // namespace

int main()
{
  if (fork() != 0) // is no child of the caller's, who may wait for all of its own
    _exit(0);
  close_range(3, ~0U, 0);
  std::signal(SIGXFSZ, SIG_IGN);
  std::ios::sync_with_stdio(false);
  std::cout.rdbuf(std::cerr.rdbuf()); // standard output is for the answer
  pydart2::messages::install();
  pydart2::share_scenes();
  for (Request request; read(request);)
    answer(request);
  _exit(0);
}
