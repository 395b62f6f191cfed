// What WorldHandle offers of state.hpp, model.hpp and clone.hpp.

#include <algorithm>

#include "archive.hpp"
#include "clone.hpp"
#include "model.hpp"
#include "state.hpp"
#include "world.hpp"

namespace pydart2 {

namespace {

void write(const std::vector<double>& numbers, Output& out)
{
  std::copy(numbers.begin(), numbers.end(), out.vector(static_cast<long>(numbers.size())));
}

std::vector<double> numbers(const VectorIn& in)
{
  return {in.data, in.data + in.size};
}

} // namespace

void WorldHandle::snapshot(bool exact, Output& out)
{
  auto& record = world();
  if (exact)
    forget_history(record);
  write(state_of(record), out);
}

void WorldHandle::restore(const VectorIn& snapshot)
{
  restore_state(world(), numbers(snapshot));
}

std::vector<std::string> WorldHandle::plan() const
{
  return blueprint(world()).plan;
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

WorldHandle WorldHandle::clone() const
{
  return WorldHandle(build(blueprint(*record_)));
}

WorldHandle WorldHandle::rebuild(
    const std::vector<std::string>& plan,
    const std::vector<std::string>& model_texts,
    const VectorIn& model_numbers,
    const VectorIn& snapshot)
{
  return WorldHandle(build({plan, model_texts, numbers(model_numbers), numbers(snapshot)}));
}

} // namespace pydart2
