// SPDX-License-Identifier: Apache-2.0
//
// Minimum cuts against all sets of nodes.
#include "apps/planner/no_path/minimum_cut.h"

#include <catch2/catch.hpp>
#include <random>

namespace nef::planner::test {
namespace {

// Whether the last node is reached from the first one without some nodes.
bool are_joined(const WeightedGraph& graph, std::uint32_t without) {
  std::vector<bool> seen(graph.neighbours.size(), false);
  std::vector<std::uint32_t> queue{0};
  seen[0] = true;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::uint32_t next : graph.neighbours[queue[i]]) {
      if (seen[next] || ((without >> next) & 1) != 0) continue;
      seen[next] = true;
      queue.push_back(next);
    }
  }
  return seen.back();
}

TEST_CASE("minimum cuts weigh as much as the best set of nodes") {
  std::mt19937 random(3);
  for (unsigned round = 0; round < 300; ++round) {
    const std::uint32_t count = 3 + random() % 7;
    WeightedGraph graph;
    graph.neighbours.resize(count);
    for (std::uint32_t v = 0; v < count; ++v) graph.weights.push_back(1 + random() % 5);
    if (random() % 3 == 0) graph.weights[random() % count] = WeightedGraph::kUncuttable;
    for (std::uint32_t v = 0; v < count; ++v) {
      for (std::uint32_t w = 0; w < v; ++w) {
        if (random() % 2 == 0 || (w == 0 && v + 1 == count && random() % 8 != 0)) continue;
        graph.neighbours[v].push_back(w);
        graph.neighbours[w].push_back(v);
      }
    }
    std::int64_t best = WeightedGraph::kUncuttable;
    for (std::uint32_t set = 0; set < (1U << count); set += 2) {
      if (((set >> (count - 1)) & 1) != 0 || are_joined(graph, set)) continue;
      std::int64_t weight = 0;
      for (std::uint32_t v = 0; v < count; ++v) weight += ((set >> v) & 1) != 0 ? graph.weights[v] : 0;
      best = std::min(best, weight);
    }
    const NodeCut cut = minimum_node_cut(graph, 0, count - 1);
    if (best >= WeightedGraph::kUncuttable) {
      CHECK(cut.weight >= WeightedGraph::kUncuttable);
      continue;
    }
    CHECK(cut.weight == best);
    std::uint32_t set = 0;
    std::int64_t weight = 0;
    for (const std::uint32_t v : cut.nodes) {
      set |= 1U << v;
      weight += graph.weights[v];
    }
    CHECK(weight == best);
    CHECK_FALSE(are_joined(graph, set));
  }
}

}  // namespace
}  // namespace nef::planner::test
