#pragma once

#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "collision/native_geometry.hpp"

namespace pydart2::native {

/// A binary tree of boxes. It is built once, top down, and its boxes grow with what moves; when that has been as much as
/// the tree has leaves, build() makes it good again. What overlaps() finds does not depend on the tree's shape, but for
/// the order.
class BoundsTree
{
public:
  /// Of the boxes with the numbers in `leaves`.
  void build(const std::vector<Bounds>& boxes, std::vector<int> leaves);

  /// Moves a leaf.
  void move(int leaf, const Bounds& bounds);
  bool worn() const { return moves_ > nodes_.size() / 2; }

  /// Calls `use` with each leaf whose box overlaps `bounds`.
  template <class Use>
  void overlaps(const Bounds& bounds, const Use& use) const
  {
    if (nodes_.empty())
      return;
    thread_local std::vector<int> stack; // `use` asks no tree
    stack.assign(1, 0);
    while (!stack.empty()) {
      const Node& node = nodes_[static_cast<std::size_t>(stack.back())];
      stack.pop_back();
      if (!node.bounds.overlaps(bounds))
        continue;
      if (node.leaf >= 0) {
        use(node.leaf);
      } else {
        stack.push_back(node.right);
        stack.push_back(node.left);
      }
    }
  }

  /// Calls `use` with each leaf of whose box, and of all boxes around it, `enters` is true.
  template <class Enters, class Use>
  void along(const Enters& enters, const Use& use) const
  {
    if (nodes_.empty())
      return;
    thread_local std::vector<int> kept; // neither asks a tree
    auto& stack = kept;
    stack.assign(1, 0);
    while (!stack.empty()) {
      const Node& node = nodes_[static_cast<std::size_t>(stack.back())];
      stack.pop_back();
      if (!enters(node.bounds))
        continue;
      if (node.leaf >= 0) {
        use(node.leaf);
      } else {
        stack.push_back(node.right);
        stack.push_back(node.left);
      }
    }
  }

  /// Calls `use` with the leaves in the order of the `least` of their boxes, as long as that is not more than what `use`
  /// last returned, or `most` at first.
  template <class Least, class Use>
  void nearest(double most, const Least& least, const Use& use) const
  {
    using Next = std::pair<double, int>;
    std::priority_queue<Next, std::vector<Next>, std::greater<>> queue;
    const auto add = [&](int index) {
      if (const double distance = least(nodes_[static_cast<std::size_t>(index)].bounds); distance <= most)
        queue.emplace(distance, index);
    };
    if (!nodes_.empty())
      add(0);
    while (!queue.empty() && queue.top().first <= most) {
      const Node& node = nodes_[static_cast<std::size_t>(queue.top().second)];
      queue.pop();
      if (node.leaf >= 0) {
        most = use(node.leaf);
      } else {
        add(node.left);
        add(node.right);
      }
    }
  }

private:
  struct Node
  {
    Bounds bounds;
    int parent, left, right, leaf; ///< -1: none.
  };

  int build(const std::vector<Bounds>& boxes, std::vector<int>::iterator begin, std::vector<int>::iterator end, int parent);

  std::vector<Node> nodes_;
  std::vector<int> leaf_of_; ///< The node of each leaf.
  std::size_t moves_ = 0;
};

} // namespace pydart2::native
