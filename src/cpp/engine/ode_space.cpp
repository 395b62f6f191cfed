#include "engine/ode_space.hpp"

#include <dart/common/Console.hpp>
#include <malloc.h>

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace pydart2 {

namespace {

struct Group : dart::collision::OdeCollisionGroup
{
  static dSpaceID space_of(OdeCollisionGroup& group) { return group.*(&Group::mSpaceId); }
};

std::string text_of(const char* format, va_list values)
{
  char text[500];
  std::vsnprintf(text, sizeof text, format, values);
  return text;
}

void failed(int, const char* format, va_list values)
{
  throw Error(Kind::engine, "the collision detector ODE cannot go on: " + text_of(format, values));
}

void warned(int, const char* format, va_list values)
{
  dtwarn << "[ODE] " << text_of(format, values) << "\n";
}

using Ints = std::vector<int>;

Ints ints_of(dSpaceID space)
{
  Ints ints(malloc_usable_size(space) / sizeof(int));
  std::memcpy(ints.data(), static_cast<const void*>(space), ints.size() * sizeof(int));
  return ints;
}

/// Where a space that nobody uses has 0 and, twice while it collides, 1 more than before; -1 if not at one place only.
long find_lock()
{
  struct Seen
  {
    dSpaceID space;
    Ints inside;
  } seen{dHashSpaceCreate(nullptr), {}};
  for (int i = 0; i < 2; ++i)
    dSpaceAdd(seen.space, dCreateSphere(nullptr, 1.0));
  const Ints before = ints_of(seen.space);
  dSpaceCollide(seen.space, &seen, [](void* data, dGeomID, dGeomID) {
    auto& here = *static_cast<Seen*>(data);
    here.inside = ints_of(here.space);
  });
  const Ints after = ints_of(seen.space);
  dSpaceDestroy(seen.space);
  long found = -1;
  if (seen.inside.size() == before.size())
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i] == 0 && seen.inside[i] == 1 && after[i] == 0) {
        if (found >= 0)
          return -1;
        found = static_cast<long>(i);
      }
  return found;
}

} // namespace

void make_ode_throw()
{
  dSetErrorHandler(failed);
  dSetDebugHandler(failed);
  dSetMessageHandler(warned);
}

void unlock_ode_space(dart::collision::CollisionGroup& group)
{
  static const long lock = find_lock();
  const dSpaceID space = Group::space_of(dynamic_cast<dart::collision::OdeCollisionGroup&>(group));
  if (lock >= 0)
    std::memset(reinterpret_cast<char*>(space) + lock * static_cast<long>(sizeof(int)), 0, sizeof(int));
}

} // namespace pydart2
