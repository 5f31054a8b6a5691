// SPDX-License-Identifier: Apache-2.0
//
// The planner's A* and Boost.Graph's on one grid of cubes, a quarter of them blocked; steps have length 1, the estimate
// is the straight distance. Prints processor seconds and nodes of both, and the ratio.
#include <boost/graph/astar_search.hpp>
#include <boost/graph/grid_graph.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <cmath>
#include <iostream>
#include <random>

#include "apps/planner/search/a_star.h"
#include "nef/base/timing/stopwatch.h"

namespace {

using nef::planner::AStar;
using Grid = boost::grid_graph<3>;
using Cube = Grid::vertex_descriptor;

constexpr std::size_t kSide = 96;

struct Search {
  double length = 0;
  std::size_t nodes = 0;
  double seconds = 0;
};

double distance_to_end(std::size_t x, std::size_t y, std::size_t z) {
  const auto left = [](std::size_t c) { return static_cast<double>(kSide - 1 - c); };
  return std::hypot(left(x), left(y), left(z));
}

Search ours(const std::vector<char>& blocked) {
  Search result;
  const nef::ProcessStopwatch watch;
  AStar search(blocked.size());
  const auto last = static_cast<AStar::Node>(blocked.size() - 1);
  search.offer(0, AStar::kNone, 0, distance_to_end(0, 0, 0));
  while (const std::optional<AStar::Node> node = search.next()) {
    ++result.nodes;
    if (*node == last) break;
    const std::array<std::size_t, 3> at{*node % kSide, *node / kSide % kSide, *node / kSide / kSide};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool up : {false, true}) {
        if (at[axis] == (up ? kSide - 1 : 0)) continue;
        std::array<std::size_t, 3> to = at;
        to[axis] += up ? 1U : static_cast<std::size_t>(-1);
        const auto next = static_cast<AStar::Node>((to[2] * kSide + to[1]) * kSide + to[0]);
        const double cost = search.cost(*node) + 1;
        if (blocked[next] != 0 || !search.improves(next, cost)) continue;
        search.offer(next, *node, cost, cost + distance_to_end(to[0], to[1], to[2]));
      }
    }
  }
  result.length = search.cost(last);
  result.seconds = watch.seconds();
  return result;
}

struct Arrived {};  // how a search of Boost's is ended

struct Visitor : boost::default_astar_visitor {
  std::size_t* nodes = nullptr;
  template <typename Graph>
  void examine_vertex(const Cube& cube, const Graph&) {
    ++*nodes;
    if (cube[0] == kSide - 1 && cube[1] == kSide - 1 && cube[2] == kSide - 1) throw Arrived{};
  }
};

Search boosts(const std::vector<char>& blocked) {
  Search result;
  const nef::ProcessStopwatch watch;
  const Grid grid(boost::array<std::size_t, 3>{{kSide, kSide, kSide}});
  const auto index = get(boost::vertex_index, grid);
  const auto map = [&index](auto& values) { return boost::make_iterator_property_map(values.begin(), index); };
  std::vector<Cube> from(blocked.size());
  std::vector<double> cost(blocked.size());
  std::vector<double> rank(blocked.size());
  std::vector<boost::default_color_type> color(blocked.size());
  const auto weight = boost::make_function_property_map<Grid::edge_descriptor>(
      [&](const Grid::edge_descriptor& edge) { return blocked[get(index, target(edge, grid))] != 0 ? HUGE_VAL : 1.0; });
  Visitor visitor;
  visitor.nodes = &result.nodes;
  try {
    boost::astar_search(
        grid, Cube{{0, 0, 0}}, [](const Cube& cube) { return distance_to_end(cube[0], cube[1], cube[2]); },
        boost::visitor(visitor)
            .weight_map(weight)
            .predecessor_map(map(from))
            .distance_map(map(cost))
            .rank_map(map(rank))
            .color_map(map(color))
            .distance_inf(HUGE_VAL));
  } catch (const Arrived&) {
    // There is no other way out.
  }
  result.length = cost.back();
  result.seconds = watch.seconds();
  return result;
}

}  // namespace

int main() {
  std::mt19937 random(5);
  std::vector<char> blocked(kSide * kSide * kSide);
  for (char& cube : blocked) cube = random() % 4 == 0 ? 1 : 0;
  blocked.front() = blocked.back() = 0;
  for (int round = 0; round < 3; ++round) {
    const Search a = ours(blocked);
    const Search b = boosts(blocked);
    std::cout << "ours " << a.seconds << " s, " << a.nodes << " nodes; Boost.Graph " << b.seconds << " s, " << b.nodes
              << " nodes; ratio " << b.seconds / a.seconds << (a.length == b.length ? "" : "; LENGTHS DIFFER") << '\n';
  }
}
