// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/assembly/closed_sets.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>

namespace nef::planner {

std::vector<std::vector<std::size_t>> minimal_closed_sets(const BlockingGraph& graph) {
  boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS> blocks(graph.size());
  for (std::size_t node = 0; node < graph.size(); ++node) {
    for (const std::size_t next : graph[node]) boost::add_edge(node, next, blocks);
  }
  std::vector<std::size_t> component(graph.size());
  const std::size_t count = boost::strong_components(
      blocks, boost::make_iterator_property_map(component.begin(), boost::get(boost::vertex_index, blocks)));
  std::vector<std::vector<std::size_t>> members(count);
  for (std::size_t node = 0; node < graph.size(); ++node) members[component[node]].push_back(node);
  for (std::size_t node = 0; node < graph.size(); ++node) {
    for (const std::size_t next : graph[node]) {
      if (component[next] != component[node]) members[component[node]].clear();
    }
  }
  std::erase_if(members, [](const auto& set) { return set.empty(); });
  return members;
}

}  // namespace nef::planner
