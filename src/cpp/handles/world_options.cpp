// How a world steps: detector, dynamics, solver, and what they may take and leave out.

#include <dart/constraint/ConstraintSolver.hpp>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "collision/detector.hpp"
#include "contact/fast_solver.hpp"
#include "engine/engine_access.hpp"
#include "handles/world.hpp"
#include "state/sleeping.hpp"

namespace pydart2 {

std::string WorldHandle::collision_detector() const
{
  return world().world->getConstraintSolver()->getCollisionDetector()->getType();
}

void WorldHandle::set_collision_detector(const std::string& name)
{
  use_detector(*to_change().world->getConstraintSolver(), make_detector(name));
}

void WorldHandle::use_engine_shapes()
{
  shape_choice(*to_change().world->getConstraintSolver()).engine_shapes = true;
}

std::string WorldHandle::dynamics() const
{
  return name_of(world().dynamics);
}

void WorldHandle::set_dynamics(const std::string& name)
{
  auto& record = to_change();
  const auto dynamics = dynamics_named(name);
  if (dynamics != Dynamics::fast && record.integrator != Integrator::engine)
    throw Error(
        Kind::value, "integrator '" + std::string(name_of(record.integrator))
                         + "' needs the fast dynamics; set_integrator(\"engine\") comes first");
  record.dynamics = dynamics;
}

std::string WorldHandle::integrator() const
{
  return name_of(world().integrator);
}

void WorldHandle::set_integrator(const std::string& name)
{
  auto& record = to_change();
  const auto integrator = integrator_named(name);
  if (integrator != Integrator::engine && record.dynamics != Dynamics::fast)
    throw Error(Kind::value, "integrator '" + name + "' needs the fast dynamics; world.set_dynamics(\"fast\") comes first");
  record.integrator = integrator;
  for (const auto& item : record.skeletons)
    item->integrator_fallbacks = 0;
}

std::string WorldHandle::constraint_solver() const
{
  return name_of(fast_solver(*world().world).solver());
}

void WorldHandle::set_constraint_solver(const std::string& name)
{
  auto& solver = fast_solver(*to_change().world);
  solver.set_solver(solver_named(name));
  solver.iterative().options = {}; // they belong to the choice
}

void WorldHandle::iterative_options(Output& out) const
{
  const auto& options = fast_solver(*world().world).iterative().options;
  vector(out, 8) << numbers_of(options), double(options.threads);
}

void WorldHandle::set_iterative_options(const VectorIn& options)
{
  auto& solver = fast_solver(*to_change().world);
  solver.iterative().options = options_of(options.eigen());
  solver.set_solver(Solver::iterative);
}

int WorldHandle::solver_iterations() const
{
  return fast_solver(*world().world).iterative().iterations_used();
}

double WorldHandle::solver_residual() const
{
  return fast_solver(*world().world).residual();
}

bool WorldHandle::deterministic() const
{
  return world().deterministic;
}

void WorldHandle::set_deterministic(bool enable)
{
  world().deterministic = enable;
}

bool WorldHandle::nan_at_blow_up() const
{
  return world().nan_at_blow_up;
}

void WorldHandle::set_nan_at_blow_up(bool enable)
{
  world().nan_at_blow_up = enable;
}

bool WorldHandle::contact_reduction() const
{
  return fast_solver(*world().world).contact_reduction();
}

void WorldHandle::set_contact_reduction(bool enable)
{
  fast_solver(*to_change().world).set_contact_reduction(enable);
}

bool WorldHandle::warm_start() const
{
  return fast_solver(*world().world).warm_start();
}

void WorldHandle::set_warm_start(bool enable)
{
  fast_solver(*to_change().world).set_warm_start(enable);
}

void WorldHandle::sleeping_options(Output& out) const
{
  const auto& sleep = world().sleep;
  auto options = vector(out, sleep.enabled ? 3 : 0);
  if (sleep.enabled)
    options << sleep.linear, sleep.angular, sleep.seconds;
}

void WorldHandle::set_sleeping_options(const VectorIn& options)
{
  auto& record = to_change();
  auto& sleep = record.sleep;
  if (options.size != 0) {
    check::size(options.size, 3, "the settings of sleep");
    for (long i = 0; i < 3; ++i)
      check::positive(options.data[i], "a setting of sleep");
    sleep.linear = options.data[0];
    sleep.angular = options.data[1];
    sleep.seconds = options.data[2];
  }
  sleep.enabled = options.size != 0;
  find_awake(record);
}

long WorldHandle::max_contacts() const
{
  const auto most = fast_solver(*world().world).getCollisionOption().maxNumContacts;
  return most == unlimited_contacts ? 0 : static_cast<long>(most);
}

void WorldHandle::set_max_contacts(long most)
{
  if (most < 0 || most > static_cast<long>(unlimited_contacts))
    throw Error(Kind::value, "the number of contacts must be positive, or None for no limit, got " + std::to_string(most));
  auto& record = to_change();
  fast_solver(*record.world).getCollisionOption().maxNumContacts
      = most == 0 ? unlimited_contacts : static_cast<std::size_t>(most);
  record.told_of_contact_limit = false;
}

double WorldHandle::constraint_error_reduction() const
{
  return fast_solver(*world().world).error_reduction();
}

void WorldHandle::set_constraint_error_reduction(double share)
{
  if (!(share >= 0.0 && share <= 1.0))
    throw Error(Kind::value, "a share of an error is a number from 0 to 1, got " + std::to_string(share));
  fast_solver(*to_change().world).set_error_reduction(share);
}

double WorldHandle::contact_memory_limit() const
{
  return fast_solver(*world().world).memory_limit();
}

void WorldHandle::set_contact_memory_limit(double bytes)
{
  check::positive(bytes, "contact memory limit");
  fast_solver(*world().world).set_memory_limit(bytes);
}

} // namespace pydart2
