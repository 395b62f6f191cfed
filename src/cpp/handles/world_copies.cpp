// What WorldHandle offers of snapshot.hpp, model_archive.hpp and clone.hpp.

#include <algorithm>

#include "base/archive.hpp"
#include "handles/world.hpp"
#include "state/clone.hpp"
#include "state/model_archive.hpp"
#include "state/snapshot.hpp"

namespace pydart2 {

namespace {

void write(const std::vector<double>& numbers, Output& out)
{
  std::copy(numbers.begin(), numbers.end(), out.vector(static_cast<long>(numbers.size())));
}

} // namespace

void WorldHandle::forget_history()
{
  pydart2::forget_history(world());
}

void WorldHandle::snapshot(Output& out)
{
  write(state_of(world()), out);
}

void WorldHandle::restore(const VectorIn& snapshot)
{
  restore_state(world(), {snapshot.data, snapshot.data + snapshot.size});
  for (const auto& skeleton : record_->skeletons) {
    skeleton->forget_last_forces();
    skeleton->last_forces(); // now, before a step clears them
  }
}

std::vector<std::string> WorldHandle::model_texts() const
{
  Archive archive;
  visit_model(archive, world());
  return archive.texts;
}

void WorldHandle::model_numbers(Output& out) const
{
  Archive archive;
  visit_model(archive, world());
  write(archive.numbers, out);
}

std::string WorldHandle::known_model_digest() const
{
  return known_digest(world());
}

void WorldHandle::remember_model_digest(const std::string& digest) const
{
  known_digest(world()) = digest;
}

Blueprint WorldHandle::blueprint() const
{
  return blueprint_of(world());
}

WorldHandle WorldHandle::rebuild(const Blueprint& blueprint)
{
  return WorldHandle(build(blueprint));
}

} // namespace pydart2
