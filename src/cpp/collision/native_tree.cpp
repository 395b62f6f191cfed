#include "collision/native_tree.hpp"

#include <algorithm>

namespace pydart2::native {

void BoundsTree::build(const std::vector<Bounds>& boxes, std::vector<int> leaves)
{
  nodes_.clear();
  nodes_.reserve(2 * leaves.size());
  leaf_of_.assign(boxes.size(), -1);
  moves_ = 0;
  if (!leaves.empty())
    build(boxes, leaves.begin(), leaves.end(), -1);
}

int BoundsTree::build(
    const std::vector<Bounds>& boxes, std::vector<int>::iterator begin, std::vector<int>::iterator end, int parent)
{
  const int index = static_cast<int>(nodes_.size());
  const auto bounds_at = [&](int leaf) -> const Bounds& { return boxes[static_cast<std::size_t>(leaf)]; };
  if (end - begin == 1) {
    nodes_.push_back({bounds_at(*begin), parent, -1, -1, *begin});
    leaf_of_[static_cast<std::size_t>(*begin)] = index;
    return index;
  }
  Bounds all = bounds_at(*begin);
  Vector least = all.low + all.high, most = least; // of the doubled centers
  for (auto it = begin; it != end; ++it) {
    const Vector center = bounds_at(*it).low + bounds_at(*it).high;
    all.add(bounds_at(*it));
    least = least.cwiseMin(center);
    most = most.cwiseMax(center);
  }
  int axis = 0;
  (most - least).maxCoeff(&axis);
  const auto middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](int a, int b) {
    const double at_a = bounds_at(a).low[axis] + bounds_at(a).high[axis], at_b = bounds_at(b).low[axis] + bounds_at(b).high[axis];
    return at_a != at_b ? at_a < at_b : a < b;
  });
  nodes_.push_back({all, parent, -1, -1, -1});
  const int left = build(boxes, begin, middle, index);
  const int right = build(boxes, middle, end, index);
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
