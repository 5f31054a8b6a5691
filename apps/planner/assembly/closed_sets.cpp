// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/assembly/closed_sets.h"

#include <algorithm>
#include <limits>

namespace nef::planner {
namespace {

class Components {
 public:
  explicit Components(const BlockingGraph& graph)
      : graph_(graph), order_(graph.size(), kNew), lowest_(graph.size(), 0), component_(graph.size(), kNew) {
    for (std::size_t node = 0; node < graph.size(); ++node) {
      if (order_[node] == kNew) visit(node);
    }
  }

  /// Components without an edge to another one.
  [[nodiscard]] std::vector<std::vector<std::size_t>> sinks() const {
    std::vector<bool> is_sink(count_, true);
    for (std::size_t node = 0; node < graph_.size(); ++node) {
      for (const std::size_t next : graph_[node]) {
        if (component_[next] != component_[node]) is_sink[component_[node]] = false;
      }
    }
    std::vector<std::vector<std::size_t>> members(count_);
    for (std::size_t node = 0; node < graph_.size(); ++node) members[component_[node]].push_back(node);
    std::vector<std::vector<std::size_t>> result;
    for (std::size_t i = 0; i < count_; ++i) {
      if (is_sink[i]) result.push_back(std::move(members[i]));
    }
    return result;
  }

 private:
  static constexpr std::size_t kNew = std::numeric_limits<std::size_t>::max();

  // As deep as there are parts.
  void visit(std::size_t node) {
    order_[node] = lowest_[node] = next_++;
    stack_.push_back(node);
    for (const std::size_t next : graph_[node]) {
      if (order_[next] == kNew) {
        visit(next);
        lowest_[node] = std::min(lowest_[node], lowest_[next]);
      } else if (component_[next] == kNew) {
        lowest_[node] = std::min(lowest_[node], order_[next]);
      }
    }
    if (lowest_[node] != order_[node]) return;
    std::size_t member = 0;
    do {
      member = stack_.back();
      stack_.pop_back();
      component_[member] = count_;
    } while (member != node);
    ++count_;
  }

  const BlockingGraph& graph_;
  std::vector<std::size_t> order_;
  std::vector<std::size_t> lowest_;
  std::vector<std::size_t> component_;
  std::vector<std::size_t> stack_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<std::vector<std::size_t>> minimal_closed_sets(const BlockingGraph& graph) {
  return Components(graph).sinks();
}

}  // namespace nef::planner
