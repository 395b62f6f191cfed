#pragma once

#include <array>
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

  /// Calls `use` with each leaf whose box, and all boxes around it, a ray enters before `most`, which `use` may lower;
  /// the nearer half of a box first. `entry` gives the distance of a box, infinity for one that is missed.
  template <class Entry, class Use>
  void along(const Entry& entry, const double& most, const Use& use) const
  {
    struct Next
    {
      double distance;
      int index;
    };
    if (nodes_.empty())
      return;
    std::array<Next, static_cast<std::size_t>(deepest) + 1> stack;
    std::size_t count = 0;
    Next next{entry(nodes_[0].bounds), 0};
    const auto pop = [&] { return count > 0 ? stack[--count] : Next{0.0, -1}; };
    while (next.index >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(next.index)];
      if (!(next.distance < most)) { // also what it misses
        next = pop();
      } else if (node.leaf >= 0) {
        use(node.leaf);
        next = pop();
      } else {
        Next far{entry(nodes_[static_cast<std::size_t>(node.right)].bounds), node.right};
        next = {entry(nodes_[static_cast<std::size_t>(node.left)].bounds), node.left};
        if (far.distance < next.distance)
          std::swap(next, far);
        if (far.distance < most)
          stack[count++] = far;
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

  static constexpr int deepest = 64;

  int build(
      const std::vector<Bounds>& boxes, std::vector<int>::iterator begin, std::vector<int>::iterator end, int parent,
      int depth);

  std::vector<Node> nodes_;
  std::vector<int> leaf_of_; ///< The node of each leaf.
  std::size_t moves_ = 0;
};

} // namespace pydart2::native
