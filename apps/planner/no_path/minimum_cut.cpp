// SPDX-License-Identifier: Apache-2.0
//
// Each node becomes an arc from its entrance (2 v) to its exit (2 v + 1) that carries its weight; arcs between nodes
// carry anything. The flow is sent along shortest ways, level by level (Dinic, Soviet Math. Doklady 1970). In the end
// the nodes whose entrance can still be reached and whose exit cannot are the cut.
#include "apps/planner/no_path/minimum_cut.h"

#include <algorithm>

namespace nef::planner {
namespace {

class Flow {
 public:
  Flow(const WeightedGraph& graph, std::uint32_t from, std::uint32_t to)
      : source_(2 * from + 1), sink_(2 * to), first_(2 * graph.neighbours.size() + 1, 0) {
    // Arcs of a vertex are consecutive, so they are counted first; each has a twin that carries back.
    const auto each_arc = [&](auto&& use) {
      for (std::uint32_t v = 0; v < graph.neighbours.size(); ++v) {
        use(2 * v, 2 * v + 1, std::min(graph.weights[v], WeightedGraph::kUncuttable));
        for (const std::uint32_t w : graph.neighbours[v]) use(2 * v + 1, 2 * w, WeightedGraph::kUncuttable);
      }
    };
    each_arc([&](std::uint32_t a, std::uint32_t b, std::int64_t) {
      ++first_[a + 1];
      ++first_[b + 1];
    });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    arcs_.resize(first_.back());
    each_arc([&](std::uint32_t a, std::uint32_t b, std::int64_t room) {
      arcs_[next[a]] = {b, next[b], room};
      arcs_[next[b]] = {a, next[a], 0};
      ++next[a];
      ++next[b];
    });
  }

  NodeCut run(const Monitor& monitor) {
    NodeCut result;
    while (find_levels()) {
      next_.assign(first_.begin(), first_.end() - 1);
      while (result.weight < WeightedGraph::kUncuttable) {
        monitor.check_interruption();
        const std::int64_t sent = send();
        if (sent == 0) break;
        result.weight += sent;
      }
      if (result.weight >= WeightedGraph::kUncuttable) return result;
    }
    for (std::uint32_t v = 0; 2 * v + 1 < levels_.size(); ++v) {
      if (levels_[2 * v] >= 0 && levels_[2 * v + 1] < 0) result.nodes.push_back(v);
    }
    return result;
  }

 private:
  struct Arc {
    std::uint32_t to = 0;
    std::uint32_t twin = 0;
    std::int64_t room = 0;
  };

  // How many arcs with room lead to each vertex at least; false if none lead to the sink.
  bool find_levels() {
    levels_.assign(first_.size() - 1, -1);
    levels_[source_] = 0;
    std::vector<std::uint32_t> queue{source_};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t v = queue[i];
      for (std::uint32_t a = first_[v]; a < first_[v + 1]; ++a) {
        if (arcs_[a].room == 0 || levels_[arcs_[a].to] >= 0) continue;
        levels_[arcs_[a].to] = levels_[v] + 1;
        queue.push_back(arcs_[a].to);
      }
    }
    return levels_[sink_] >= 0;
  }

  // Sends as much as one way from level to level carries.
  std::int64_t send() {
    std::vector<std::uint32_t> way;
    std::uint32_t v = source_;
    while (v != sink_) {
      std::uint32_t& a = next_[v];
      while (a < first_[v + 1] && (arcs_[a].room == 0 || levels_[arcs_[a].to] != levels_[v] + 1)) ++a;
      if (a < first_[v + 1]) {
        way.push_back(a);
        v = arcs_[a].to;
        continue;
      }
      if (way.empty()) return 0;
      levels_[v] = -1;  // a dead end
      v = arcs_[arcs_[way.back()].twin].to;
      way.pop_back();
    }
    std::int64_t least = WeightedGraph::kUncuttable;
    for (const std::uint32_t a : way) least = std::min(least, arcs_[a].room);
    for (const std::uint32_t a : way) {
      arcs_[a].room -= least;
      arcs_[arcs_[a].twin].room += least;
    }
    return least;
  }

  std::uint32_t source_;
  std::uint32_t sink_;
  std::vector<std::uint32_t> first_;  // of each vertex the first arc
  std::vector<Arc> arcs_;
  std::vector<std::int32_t> levels_;
  std::vector<std::uint32_t> next_;  // of each vertex the arc to try
};

}  // namespace

NodeCut minimum_node_cut(const WeightedGraph& graph, std::uint32_t from, std::uint32_t to, const Monitor& monitor) {
  return Flow(graph, from, to).run(monitor);
}

}  // namespace nef::planner
