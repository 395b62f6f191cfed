// What WorldHandle offers of state.hpp, model.hpp and clone.hpp.

#include <algorithm>

#include "checks.hpp"
#include "clone.hpp"
#include "errors.hpp"
#include "model.hpp"
#include "state.hpp"
#include "world.hpp"

namespace pydart2 {

namespace {

void write(const std::vector<double>& numbers, Output& out)
{
  std::copy(numbers.begin(), numbers.end(), out.vector(static_cast<long>(numbers.size())));
}

} // namespace

void WorldHandle::snapshot(bool exact, Output& out)
{
  auto& record = world();
  if (exact)
    forget_history(record);
  Archive archive;
  visit_state(archive, record);
  write(archive.numbers, out);
}

void WorldHandle::restore(const VectorIn& snapshot)
{
  auto& record = world();
  Archive size;
  visit_state(size, record);
  check::size(snapshot.size, size.numbers.size(), "the snapshot");
  if (!snapshot.eigen().allFinite())
    throw Error(Kind::value, "the snapshot must be finite");
  Archive archive({}, {snapshot.data, snapshot.data + snapshot.size});
  visit_state(archive, record);
  forget_history(record);
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
  Busy busy(*record_);
  return WorldHandle(build(blueprint(*record_)));
}

WorldHandle WorldHandle::rebuild(
    const std::vector<std::string>& plan,
    const std::vector<std::string>& model_texts,
    const VectorIn& model_numbers,
    const VectorIn& snapshot)
{
  const auto numbers = [](const VectorIn& in) { return std::vector<double>(in.data, in.data + in.size); };
  return WorldHandle(build({plan, model_texts, numbers(model_numbers), numbers(snapshot)}));
}

} // namespace pydart2
