// SPDX-License-Identifier: Apache-2.0
//
// The cheapest nodes of a graph that separate two others.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/base/monitor.h"

namespace nef::planner {

/// A graph by the neighbours of each node, in both directions, with a weight for each node.
struct WeightedGraph {
  std::vector<std::vector<std::uint32_t>> neighbours;
  std::vector<std::int64_t> weights;  ///< kUncuttable or more: a node that cannot be in a cut
  static constexpr std::int64_t kUncuttable = std::int64_t{1} << 50;
};

/// What separates two nodes.
struct NodeCut {
  std::int64_t weight = 0;           ///< kUncuttable or more: there is none
  std::vector<std::uint32_t> nodes;  ///< of those with the least weight, the ones nearest to the first node
};

/// The nodes of least total weight without which no way leads from one node to another one, neither of which counts.
/// A maximal flow by Dinic's algorithm: O(n^2 m) at worst, a few passes over the graph in practice. `monitor` can stop
/// it (Interrupted).
NodeCut minimum_node_cut(const WeightedGraph& graph, std::uint32_t from, std::uint32_t to, const Monitor& monitor = {});

}  // namespace nef::planner
