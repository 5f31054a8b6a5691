// SPDX-License-Identifier: Apache-2.0
//
// Sets of a blocking graph that nothing outside of them blocks.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace nef::planner {

/// Of each node, those that block it.
using BlockingGraph = std::vector<std::vector<std::size_t>>;

/// The minimal sets that no edge leaves: the strongly connected components without a way out [Tarjan 1972]. All of them
/// are disjoint; a graph with nodes has at least one. O(nodes + edges).
std::vector<std::vector<std::size_t>> minimal_closed_sets(const BlockingGraph& graph);

/// Calls visit(set) for every set that no edge leaves, neither empty nor all. For up to 20 nodes: O(2^n).
void for_each_closed_set(const BlockingGraph& graph, const std::function<void(const std::vector<std::size_t>&)>& visit);

}  // namespace nef::planner
