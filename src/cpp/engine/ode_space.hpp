#pragma once

#include <dart/collision/ode/OdeCollisionGroup.hpp>

namespace pydart2 {

/// From now on what ODE would print and end the process for throws Kind::engine, and its warnings go to the log.
void make_ode_throw();

/// Frees a space that an exception has left locked: while it collides, ODE lets nothing be moved in it or freed.
///
/// Relied on: a space counts its locks in an int of its own, which is found once by looking at what one counts up while
/// it collides. Where that is not found (another layout), nothing is done and Kind::engine says at the next use that the
/// space is locked.
void unlock_ode_space(dart::collision::CollisionGroup& group);

} // namespace pydart2
