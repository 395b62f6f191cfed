// What a WorldHandle says of bodies that pass through each other.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/checks.hpp"
#include "base/errors.hpp"
#include "handles/world.hpp"

namespace pydart2 {

using dart::dynamics::BodyNode;

namespace {

std::vector<BodyNode*> bodies_of(const WorldRecord& world, const MatrixIn& rows)
{
  check::shape(rows, static_cast<std::size_t>(rows.rows), 2, "bodies");
  std::vector<BodyNode*> bodies;
  for (long i = 0; i < rows.rows; ++i) {
    const auto skeleton = check::index(static_cast<long>(rows.data[2 * i]), world.skeletons.size(), "skeleton");
    auto& tree = *world.skeletons[skeleton]->skeleton;
    bodies.push_back(
        tree.getBodyNode(check::index(static_cast<long>(rows.data[2 * i + 1]), tree.getNumBodyNodes(), "body")));
  }
  return bodies;
}

std::uint32_t bits(double value, const char* what)
{
  if (!(value >= 0.0 && value <= 4294967295.0 && value == std::floor(value)))
    throw Error(Kind::value, std::string("a collision ") + what + " is 32 bits, 0 to 2**32 - 1, got " + std::to_string(value));
  return static_cast<std::uint32_t>(value);
}

} // namespace

void WorldHandle::ignore_pairs(const MatrixIn& a, const MatrixIn& b, bool ignore)
{
  auto& record = to_change();
  std::vector<std::pair<BodyNode*, BodyNode*>> named;
  std::set<std::pair<BodyNode*, BodyNode*>> seen; // by address, so that a pair has one place in both orders
  const auto ones = bodies_of(record, a), others = bodies_of(record, b);
  for (std::size_t i = 0; i < ones.size(); ++i)
    for (std::size_t j = 0; j < others.size(); ++j)
      if (ones[i] != others[j] && seen.insert(std::minmax(ones[i], others[j])).second) {
        // The body that the world has first is the first of the pair, whichever was named first: models compare so.
        const bool in_order = std::lexicographical_compare(
            a.data + 2 * i, a.data + 2 * i + 2, b.data + 2 * j, b.data + 2 * j + 2);
        named.emplace_back(in_order ? ones[i] : others[j], in_order ? others[j] : ones[i]);
      }
  auto& pairs = record.ignored_pairs;
  const auto is_named = [&](const auto& pair) { return seen.count(std::minmax(pair.first, pair.second)) != 0; };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_named), pairs.end());
  if (ignore)
    pairs.insert(pairs.end(), named.begin(), named.end());
  apply_collision_filter(record);
}

void WorldHandle::ignore_no_pair()
{
  auto& record = to_change();
  record.ignored_pairs.clear();
  apply_collision_filter(record);
}

void WorldHandle::ignored_pairs(Output& out) const
{
  const auto& record = world();
  auto rows = matrix(out, static_cast<long>(record.ignored_pairs.size()), 4);
  long row = 0;
  for (const auto& [body1, body2] : record.ignored_pairs) {
    for (const auto* body : {body1, body2}) {
      const long column = body == body1 ? 0 : 2;
      rows(row, column) = record.index_of(body->getSkeleton());
      rows(row, column + 1) = static_cast<double>(body->getIndexInSkeleton());
    }
    ++row;
  }
}

void WorldHandle::set_collision_bits(const MatrixIn& bodies, double group, double mask)
{
  auto& record = to_change();
  const engine::CollisionBits chosen{bits(group, "group"), bits(mask, "mask")};
  for (const auto* body : bodies_of(record, bodies)) {
    record.collision_bits.erase(body);
    if (!chosen.usual())
      record.collision_bits[body] = chosen;
  }
  apply_collision_filter(record);
}

void WorldHandle::collision_bits(const BodyNodeHandle& body, Output& out) const
{
  const auto& all = world().collision_bits;
  const auto found = all.find(&body.body());
  const auto of = found == all.end() ? engine::CollisionBits() : found->second;
  vector(out, 2) << double(of.group), double(of.mask);
}

} // namespace pydart2
