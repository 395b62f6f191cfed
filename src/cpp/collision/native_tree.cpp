#include "collision/native_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pydart2::native {

void BoundsTree::build(const std::vector<Bounds>& boxes, std::vector<int> leaves)
{
  nodes_.clear();
  nodes_.reserve(2 * leaves.size());
  leaf_of_.assign(boxes.size(), -1);
  moves_ = 0;
  if (!leaves.empty())
    build(boxes, leaves.begin(), leaves.end(), -1, 0);
}

namespace {

using Leaves = std::vector<int>::iterator;

Vector doubled_center(const Bounds& bounds) { return bounds.low + bounds.high; }

double half_area(const Bounds& bounds)
{
  const Vector size = bounds.high - bounds.low;
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

struct Bin
{
  Bounds bounds{Vector::Constant(std::numeric_limits<double>::infinity()), Vector::Constant(-std::numeric_limits<double>::infinity())};
  int count = 0;

  void add(const Bin& other)
  {
    bounds.add(other.bounds);
    count += other.count;
  }
  double cost() const { return count > 0 ? count * half_area(bounds) : 0.0; }
};

/// Parts leaves where a ray or a box is likely to meet the fewest of them: by the areas of the boxes of both sides, tried at
/// a few places of the axis on which the centers are farthest apart. In the middle where that parts nothing.
Leaves split(const std::vector<Bounds>& boxes, Leaves begin, Leaves end, const Vector& least, const Vector& most, bool balanced)
{
  constexpr int bins = 12;
  int axis = 0;
  const double width = (most - least).maxCoeff(&axis);
  const auto at = [&](int leaf) { return doubled_center(boxes[static_cast<std::size_t>(leaf)])[axis]; };
  const auto middle = begin + (end - begin) / 2;
  if (!balanced && width > 0.0 && std::isfinite(width) && end - begin > 2) {
    const auto bin_of = [&](int leaf) { return std::min(bins - 1, static_cast<int>(bins * ((at(leaf) - least[axis]) / width))); };
    std::array<Bin, bins> left, right;
    for (auto it = begin; it != end; ++it)
      left[static_cast<std::size_t>(bin_of(*it))].add({boxes[static_cast<std::size_t>(*it)], 1});
    right = left;
    for (std::size_t i = 1; i < bins; ++i) {
      left[i].add(left[i - 1]);
      right[bins - 1 - i].add(right[bins - i]);
    }
    int best = -1;
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < bins; ++i)
      if (const double cost = left[i].cost() + right[i + 1].cost(); cost < lowest) {
        lowest = cost;
        best = static_cast<int>(i);
      }
    const auto found = std::partition(begin, end, [&](int leaf) { return bin_of(leaf) <= best; });
    if (found != begin && found != end)
      return found;
  }
  std::nth_element(begin, middle, end, [&](int a, int b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
  return middle;
}

} // namespace

int BoundsTree::build(const std::vector<Bounds>& boxes, Leaves begin, Leaves end, int parent, int depth)
{
  const int index = static_cast<int>(nodes_.size());
  const auto bounds_at = [&](int leaf) -> const Bounds& { return boxes[static_cast<std::size_t>(leaf)]; };
  if (end - begin == 1) {
    nodes_.push_back({bounds_at(*begin), parent, -1, -1, *begin});
    leaf_of_[static_cast<std::size_t>(*begin)] = index;
    return index;
  }
  Bounds all = bounds_at(*begin);
  Vector least = doubled_center(all), most = least;
  for (auto it = begin; it != end; ++it) {
    const Vector center = doubled_center(bounds_at(*it));
    all.add(bounds_at(*it));
    least = least.cwiseMin(center);
    most = most.cwiseMax(center);
  }
  const auto middle = split(boxes, begin, end, least, most, depth >= deepest / 2);
  nodes_.push_back({all, parent, -1, -1, -1});
  const int left = build(boxes, begin, middle, index, depth + 1);
  const int right = build(boxes, middle, end, index, depth + 1);
  nodes_[static_cast<std::size_t>(index)].left = left;
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

void BoundsTree::move(int leaf, const Bounds& bounds)
{
  int index = leaf_of_[static_cast<std::size_t>(leaf)];
  nodes_[static_cast<std::size_t>(index)].bounds = bounds;
  ++moves_;
  for (index = nodes_[static_cast<std::size_t>(index)].parent; index >= 0; index = nodes_[static_cast<std::size_t>(index)].parent) {
    Node& node = nodes_[static_cast<std::size_t>(index)];
    if (node.bounds.contains(bounds))
      return;
    node.bounds.add(bounds);
  }
}

} // namespace pydart2::native
