// SPDX-License-Identifier: Apache-2.0
//
// Sets of a blocking graph that nothing outside of them blocks.
#pragma once

#include <cstddef>
#include <vector>

namespace nef::planner {

/// Of each node, those that block it.
using BlockingGraph = std::vector<std::vector<std::size_t>>;

/// The minimal sets that no edge leaves: the strongly connected components without a way out [Tarjan 1972]. All of them
/// are disjoint; a graph with nodes has at least one. O(nodes + edges).
std::vector<std::vector<std::size_t>> minimal_closed_sets(const BlockingGraph& graph);

}  // namespace nef::planner
