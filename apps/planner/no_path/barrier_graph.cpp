// SPDX-License-Identifier: Apache-2.0
//
// The minimum cut between start and goal in the graph of the open cells is where a barrier seems to be cheapest. When
// nothing is left of it, all ways meet blocked cells. What is reached from the start then is its side of the barrier,
// all other open cells are the goal's.
#include "apps/planner/no_path/barrier_graph.h"

#include <algorithm>
#include <utility>

#include "nef/base/error.h"

namespace nef::planner {

using Kind = PathProof::PoseCell::Kind;
using State = BarrierCell::State;

double BarrierCell::middle_of_axis() const { return box.middle()[static_cast<Eigen::Index>(axis)]; }

BarrierGraph::BarrierGraph(const PathProof::Claim& claim, const Rational3& reference, double reach)
    : is_bounded_(claim.box.has_value()),
      bounds_(claim, reference, reach),
      ends_{reference_position(claim.path.front(), reference), reference_position(claim.path.back(), reference)} {
  cells_.emplace_back().is_hopeless = true;  // outside
}

BarrierGraph::Id BarrierGraph::add_root(std::vector<BlockingPairs::Pair> pairs) {
  BarrierCell& all = cells_.emplace_back();
  all.box = bounds_.rough;
  all.pairs = std::move(pairs);
  const Id root = kOutside + 1;
  link(kOutside, root);
  return root;
}

std::array<BarrierGraph::Id, 2> BarrierGraph::cut(Id id) {
  const auto first = static_cast<Id>(cells_.size());
  for (const bool upper : {false, true}) {
    const BarrierCell& cell = cells_[id];
    BarrierCell half;
    half.box = cell.box;
    half.pairs = cell.pairs;
    (upper ? half.box.low : half.box.high)[static_cast<Eigen::Index>(cell.axis)] = cell.middle_of_axis();
    cells_.push_back(std::move(half));
  }
  cells_[id].state = State::kCut;
  cells_[id].halves = {first, first + 1};
  cells_[id].blocked = {};
  link(first, first + 1);
  for (const Id other : std::exchange(cells_[id].neighbours, {})) {
    if (cells_[other].state == State::kCut) continue;
    link(first, other);
    link(first + 1, other);
  }
  return cells_[id].halves;
}

BarrierGraph::Id BarrierGraph::cell_of(const Vector3d& position) const {
  if (!bounds_.rough.has(position)) return kOutside;
  Id id = kOutside + 1;
  while (cells_[id].state == State::kCut) {
    const std::array<Id, 2>& halves = cells_[id].halves;
    id = halves[cells_[halves[0]].box.has(position) ? 0 : 1];
  }
  return id;
}

bool BarrierGraph::touches_outside(const PositionBox& box) const {
  const PositionBox& all = bounds_.rough;
  return (box.low.array() == all.low.array()).any() || (box.high.array() == all.high.array()).any();
}

bool BarrierGraph::have_facet_in_common(const PositionBox& a, const PositionBox& b) {
  std::array<double, 3> gaps{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    gaps[k] = std::max(a.low[i], b.low[i]) - std::min(a.high[i], b.high[i]);
  }
  return std::all_of(gaps.begin(), gaps.end(), [](double gap) { return gap <= 0; }) &&
         std::count(gaps.begin(), gaps.end(), 0.0) == 1;
}

void BarrierGraph::link(Id a, Id b) {
  const BarrierCell& first = cells_[a];
  const BarrierCell& second = cells_[b];
  if (first.state == State::kBlocked || second.state == State::kBlocked) return;
  if (std::min(a, b) == kOutside ? is_bounded_ || !touches_outside(a == kOutside ? second.box : first.box)
                                 : !have_facet_in_common(first.box, second.box)) {
    return;
  }
  cells_[a].neighbours.push_back(b);
  cells_[b].neighbours.push_back(a);
}

std::vector<BarrierGraph::Id> BarrierGraph::cheapest_barrier(const Monitor& monitor) {
  WeightedGraph graph;
  for (const BarrierCell& cell : cells_) {
    graph.weights.push_back(cell.weight);
    std::vector<std::uint32_t>& neighbours = graph.neighbours.emplace_back();
    if (cell.state != State::kOpen) continue;
    for (const Id other : cell.neighbours) {
      if (cells_[other].state == State::kOpen) neighbours.push_back(other);
    }
  }
  const Id start = cell_of(ends_[0]);
  const Id goal = cell_of(ends_[1]);
  if (cells_[start].state != State::kOpen || cells_[goal].state != State::kOpen) return {};
  NodeCut found{WeightedGraph::kUncuttable, {}};
  if (start != goal) found = minimum_node_cut(graph, start, goal, monitor);
  in_question_ = found.nodes;
  is_found_ = found.weight == 0;
  if (found.weight < WeightedGraph::kUncuttable) return found.nodes;
  found.nodes.clear();
  for (const Id end : {start, goal}) {
    if (!cells_[end].is_hopeless && std::find(found.nodes.begin(), found.nodes.end(), end) == found.nodes.end()) {
      found.nodes.push_back(end);
    }
  }
  return found.nodes;
}

std::vector<bool> BarrierGraph::reached() const {
  std::vector<bool> result(cells_.size(), false);
  std::vector<Id> queue{cell_of(ends_[0])};
  result[queue.front()] = true;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const Id next : cells_[queue[i]].neighbours) {
      if (result[next] || cells_[next].state != State::kOpen) continue;
      result[next] = true;
      queue.push_back(next);
    }
  }
  return result;
}

PathProof::PoseCells BarrierGraph::take_written(const Rational3& reference, std::size_t charts) {
  NEF_ASSERT(is_found_);
  PathProof::PoseCells result;
  result.reference = reference;
  result.bounds = bounds_.exact;
  const std::vector<bool> at_start = reached();
  result.outside_at_start = at_start[kOutside];
  result.charts.reserve(charts);
  for (std::size_t chart = 0; chart < charts; ++chart) {
    result.charts.push_back(take_written(kOutside + 1, chart, at_start));
  }
  return result;
}

PathProof::PoseCell BarrierGraph::take_written(Id id, std::size_t chart, const std::vector<bool>& at_start) {
  BarrierCell& cell = cells_[id];
  if (cell.state == State::kBlocked) return std::move(cell.blocked[chart]);
  PathProof::PoseCell result;
  result.kind = at_start[id] ? Kind::kStart : Kind::kGoal;
  if (cell.state == State::kOpen) return result;
  result.halves.reserve(2);  // nothing is copied again
  for (const Id half : cell.halves) result.halves.push_back(take_written(half, chart, at_start));
  const Kind kind = result.halves[0].kind;
  if (kind == result.halves[1].kind && (kind == Kind::kStart || kind == Kind::kGoal)) {
    result.kind = kind;
    result.halves.clear();
    return result;
  }
  result.kind = Kind::kCut;
  result.axis = cell.axis;
  result.at = exact_rational(cell.middle_of_axis());
  return result;
}

}  // namespace nef::planner
