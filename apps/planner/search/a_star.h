// SPDX-License-Identifier: Apache-2.0
//
// The bookkeeping of A* [Hart, Nilsson, Raphael 1968] over numbered nodes. Who searches expands nodes itself, so
// that edges that are costly to check are checked only when they would improve something (as in
// [Bohlin, Kavraki 2000]), which a library's search over a graph with given edges does not allow. Where edges cost
// nothing Boost.Graph's search is slower, too: bench/planner/grid_search.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace nef::planner {

/// What a search knows about its nodes: the best way to each so far, and which to look at next.
class AStar {
 public:
  using Node = std::uint32_t;
  static constexpr Node kNone = 0xffffffffU;

  explicit AStar(std::size_t nodes) : bound_(nodes, HUGE_VAL), cost_(nodes), from_(nodes) {}

  /// No way leads over the node.
  void close(Node node) { bound_[node] = kClosed; }
  /// True if a way of this cost, not below 0, to a node would be better than any known one.
  [[nodiscard]] bool improves(Node node, double cost) const { return cost < bound_[node]; }
  /// Notes a way that improves: over node `from` (kNone: from the start) at this cost; `estimate` is a lower bound of
  /// the cost from start to goal over the node.
  void offer(Node node, Node from, double cost, double estimate) {
    bound_[node] = cost;
    cost_[node] = cost;
    from_[node] = from;
    open_.emplace(estimate, node);
  }
  /// Settles the open node with the least estimate; nothing if none is open. O(log n).
  std::optional<Node> next() {
    while (!open_.empty()) {
      const Node node = open_.top().second;
      open_.pop();
      if (bound_[node] == kClosed) continue;
      close(node);
      return node;
    }
    return std::nullopt;
  }

  /// The cost of the best way to a node that was offered one.
  [[nodiscard]] double cost(Node node) const { return cost_[node]; }
  /// The nodes of the best way to a node, from the first one.
  [[nodiscard]] std::vector<Node> way_to(Node node) const {
    std::vector<Node> way;
    for (; node != kNone; node = from_[node]) way.push_back(node);
    std::reverse(way.begin(), way.end());
    return way;
  }

 private:
  using Entry = std::pair<double, Node>;

  static constexpr double kClosed = -1;

  std::vector<double> bound_;  // of what improves: the cost of a node, or kClosed where it is settled
  std::vector<double> cost_;
  std::vector<Node> from_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace nef::planner
