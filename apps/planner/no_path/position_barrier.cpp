// SPDX-License-Identifier: Apache-2.0
//
// 1. Boxes of positions are judged by sample orientations: if the middle is blocked at each of them, all orientations
//    may be, and the less deep pieces overlap there, the more parts it takes to show it.
// 2. The minimum cut between start and goal in the graph of boxes is the barrier that seems to be cheapest. Boxes of it
//    of which only a part is blocked are halved; when there are none left, its boxes are covered exactly
//    (pose_cover.h).
// 3. A pose that turns out to be open is one more sample, so that other boxes are judged better, and the cut is made
//    anew, until all of its boxes are covered.
#include "apps/planner/no_path/position_barrier.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/planner/no_path/minimum_cut.h"
#include "nef/base/error.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using Kind = PathProof::PoseCell::Kind;

constexpr std::uint32_t kOutside = 0;
constexpr std::uint32_t kAll = 1;

}  // namespace

PositionBarrier::PositionBarrier(const PathProof::Claim& claim, const Orientations& orientations,
                                 const Rational3& reference, const Monitor& monitor)
    : orientations_(orientations),
      reference_(reference),
      pairs_(claim, orientations, reference),
      monitor_(monitor),
      is_bounded_(claim.box.has_value()),
      bounds_(claim, reference, pairs_.reach()),
      ends_{reference_position(claim.path.front(), reference), reference_position(claim.path.back(), reference)} {
  add_samples();
  Cell& outside = cells_.emplace_back();
  outside.is_hopeless = true;
  Cell all;
  all.box = bounds_.rough;
  all.pairs = pairs_.all();
  judge(all);
  cells_.push_back(std::move(all));
  link(kOutside, kAll);
}

// The corners, the middle and the middles of the octants of each chart (of its ends and quarters, if it is an arc).
void PositionBarrier::add_samples() {
  for (std::uint32_t chart = 0; chart < orientations_.charts().size(); ++chart) {
    std::vector<std::array<double, 3>> points{{0, 0, 0}};
    for (const double far : {1.0, 0.5}) {
      for (std::size_t i = 0; i < (std::size_t{1} << orientations_.dimension()); ++i) {
        std::array<double, 3> point{};
        for (std::size_t k = 0; k < orientations_.dimension(); ++k) point[k] = ((i >> k) & 1) != 0 ? far : -far;
        points.push_back(point);
      }
    }
    for (const std::array<double, 3>& point : points) {
      const bool is_special = orientations_.dimension() > 1 && std::fabs(point[0]) != 0.5;
      samples_.push_back({pairs_.turned({chart, point, point}), is_special ? 0.01 : 1});
    }
  }
}

double PositionBarrier::depth(const Cell& cell, const TurnedRobot& robot, const Vector3d& position) const {
  double most = pairs_.beyond(robot, {position, position}).first;
  for (const BlockingPairs::Pair& pair : cell.pairs) most = std::max(most, pairs_.at(pair, robot, position).depth);
  return most;
}

// About how many ranges of orientations it takes to show that a position is blocked at all of them; infinite if it is
// free at one of the samples.
double PositionBarrier::effort_at(const Cell& cell, const Vector3d& position) {
  double effort = 0;
  double weights = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double deep = depth(cell, samples_[i].robot, position);
    if (deep <= pairs_.resolution()) {
      std::swap(samples_[i], samples_[i / 2]);
      return HUGE_VAL;
    }
    const double ranges = std::pow(pairs_.reach() / deep, static_cast<double>(orientations_.dimension()) / 2);
    effort += samples_[i].weight * ranges;
    weights += samples_[i].weight;
  }
  return effort / weights;
}

void PositionBarrier::judge(Cell& cell) {
  monitor_.check_interruption();
  std::erase_if(cell.pairs, [&](const BlockingPairs::Pair& pair) { return !pairs_.may_meet(pair, cell.box); });
  cell.effort = effort_at(cell, cell.box.middle());
  cell.is_blocked = cell.effort < HUGE_VAL;
  const bool is_small = (cell.box.high - cell.box.low).maxCoeff() < pairs_.reach() / 512;
  cell.is_hopeless = !cell.is_blocked && ((cell.pairs.empty() && (!is_bounded_ || is_zero(reference_))) || is_small);
  choose_axis(cell);
}

// The axis along which the effort differs most between the middles of facets and that of the box, and whether it is low
// everywhere; the longest axis if nothing is blocked.
void PositionBarrier::choose_axis(Cell& cell) {
  constexpr double kMuchMore = 1.15;
  const double size = (cell.box.high - cell.box.low).maxCoeff();
  cell.is_settled = cell.is_blocked;
  double best = -1;
  for (Eigen::Index axis = 0; !cell.is_hopeless && axis < 3; ++axis) {
    if (bounds_.is_flat[static_cast<std::size_t>(axis)]) continue;
    const double width = cell.box.high[axis] - cell.box.low[axis];
    double rank = width / size;
    for (const bool upper : {false, true}) {
      Vector3d at = cell.box.middle();
      at[axis] = upper ? cell.box.high[axis] : cell.box.low[axis];
      const double effort = effort_at(cell, at);
      if (cell.is_blocked && effort > kMuchMore * cell.effort && (effort == HUGE_VAL || width > pairs_.reach() / 16)) {
        cell.is_settled = false;
        rank += effort == HUGE_VAL ? 2 : 1;
      }
      if (!cell.is_blocked && effort < HUGE_VAL) rank += 2;
    }
    if (rank <= best) continue;
    best = rank;
    cell.axis = axis;
  }
}

PositionBarrier::CellId PositionBarrier::cell_of(const Vector3d& position) const {
  if (!bounds_.rough.has(position)) return kOutside;
  CellId id = kAll;
  while (cells_[id].state == State::kCut) {
    id = cells_[id].halves[cells_[cells_[id].halves[0]].box.has(position) ? 0 : 1];
  }
  return id;
}

void PositionBarrier::link(CellId a, CellId b) {
  const PositionBox& first = cells_[a].box;
  const PositionBox& second = cells_[b].box;
  if (std::min(a, b) == kOutside) {
    if (is_bounded_) return;
    const PositionBox& box = a == kOutside ? second : first;
    if ((box.low.array() != bounds_.rough.low.array()).all() && (box.high.array() != bounds_.rough.high.array()).all())
      return;
  } else {
    int touching = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double gap = std::max(first.low[k], second.low[k]) - std::min(first.high[k], second.high[k]);
      if (gap > 0) return;
      if (gap == 0) ++touching;
    }
    if (touching != 1) return;
  }
  cells_[a].neighbours.push_back(b);
  cells_[b].neighbours.push_back(a);
}

void PositionBarrier::cut(CellId id) {
  const auto first = static_cast<CellId>(cells_.size());
  for (const bool upper : {false, true}) {
    Cell half;
    half.box = cells_[id].box;
    half.pairs = cells_[id].pairs;
    (upper ? half.box.low : half.box.high)[cells_[id].axis] = cells_[id].box.middle()[cells_[id].axis];
    judge(half);
    cells_.push_back(std::move(half));
  }
  cells_[id].state = State::kCut;
  cells_[id].halves = {first, first + 1};
  link(first, first + 1);
  for (const CellId other : std::exchange(cells_[id].neighbours, {})) {
    if (cells_[other].state == State::kCut) continue;
    link(first, other);
    link(first + 1, other);
  }
}

// Covers a box; if a pose in it is open, that is a sample from now on.
bool PositionBarrier::cover(CellId id, std::size_t& budget) {
  PoseCover found = cover_poses(pairs_, orientations_, cells_[id].box, budget, monitor_);
  if (!found.open) {
    cells_[id].state = State::kCovered;
    cells_[id].cover = std::move(found.charts);
    return true;
  }
  if (budget == 0) return false;
  samples_.insert(samples_.begin(), {pairs_.turned(found.open->orientation), 1});
  for (Cell& cell : cells_) {
    if (cell.state != State::kOpen || !cell.is_blocked) continue;
    if (depth(cell, samples_.front().robot, cell.box.middle()) <= pairs_.resolution()) judge(cell);
  }
  budget -= std::min(budget, cells_.size() / 4);
  Cell& cell = cells_[id];
  // It is cut towards the open pose.
  if (cell.is_settled) {
    cell.is_settled = false;
    ((found.open->position - cell.box.middle()).array().abs() / (cell.box.high - cell.box.low).array())
        .maxCoeff(&cell.axis);
  }
  return true;
}

// One round; false if nothing is left to be done.
bool PositionBarrier::advance(std::size_t& budget) {
  WeightedGraph graph;
  for (const Cell& cell : cells_) {
    constexpr double kFree = 1e7;
    constexpr double kUnsettled = 4;
    const double effort =
        cell.is_blocked ? std::min(kFree / 10, 1 + cell.effort * (cell.is_settled ? 1 : kUnsettled)) : kFree;
    graph.weights.push_back(cell.is_hopeless ? WeightedGraph::kUncuttable : static_cast<std::int64_t>(16 * effort));
    std::vector<std::uint32_t>& neighbours = graph.neighbours.emplace_back();
    if (cell.state != State::kOpen) continue;
    for (const CellId other : cell.neighbours) {
      if (cells_[other].state == State::kOpen) neighbours.push_back(other);
    }
  }
  const CellId start = cell_of(ends_[0]);
  const CellId goal = cell_of(ends_[1]);
  if (cells_[start].state != State::kOpen || cells_[goal].state != State::kOpen) return false;
  NodeCut found{WeightedGraph::kUncuttable, {}};
  if (start != goal) found = minimum_node_cut(graph, start, goal);
  in_question_ = found.nodes.size();
  if (found.weight == 0) {
    is_found_ = true;
    return false;
  }
  if (found.weight >= WeightedGraph::kUncuttable) {
    found.nodes.clear();
    for (const CellId end : {start, goal}) {
      if (end != kOutside && !cells_[end].is_hopeless &&
          std::find(found.nodes.begin(), found.nodes.end(), end) == found.nodes.end())
        found.nodes.push_back(end);
    }
    if (found.nodes.empty()) return false;
  }
  bool any = false;
  for (const CellId id : found.nodes) {
    if (cells_[id].is_settled || budget == 0) continue;
    cut(id);
    --budget;
    any = true;
  }
  if (any) return budget > 0;
  // The hardest one first.
  std::sort(found.nodes.begin(), found.nodes.end(),
            [&](CellId a, CellId b) { return cells_[a].effort > cells_[b].effort; });
  for (const CellId id : found.nodes) {
    if (!cover(id, budget)) return false;
    if (cells_[id].state != State::kCovered) break;
  }
  return true;
}

bool PositionBarrier::find(std::size_t& budget) {
  while (advance(budget)) {
    monitor_.check_interruption();
    budget -= std::min(budget, cells_.size() / 32);  // for the graph
  }
  return is_found_;
}

std::vector<bool> PositionBarrier::reached() const {
  std::vector<bool> result(cells_.size(), false);
  std::vector<CellId> queue{cell_of(ends_[0])};
  result[queue.front()] = true;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const CellId next : cells_[queue[i]].neighbours) {
      if (result[next] || cells_[next].state != State::kOpen) continue;
      result[next] = true;
      queue.push_back(next);
    }
  }
  return result;
}

PathProof::PoseCells PositionBarrier::written() const {
  NEF_ASSERT(is_found_);
  PathProof::PoseCells result;
  result.reference = reference_;
  result.bounds = bounds_.exact;
  const std::vector<bool> at_start = reached();
  result.outside_at_start = at_start[kOutside];
  for (std::size_t chart = 0; chart < orientations_.charts().size(); ++chart) {
    result.charts.push_back(written(kAll, chart, at_start));
  }
  return result;
}

PathProof::PoseCell PositionBarrier::written(CellId id, std::size_t chart, const std::vector<bool>& at_start) const {
  const Cell& cell = cells_[id];
  if (cell.state == State::kCovered) return cell.cover[chart];
  PathProof::PoseCell result;
  result.kind = at_start[id] ? Kind::kStart : Kind::kGoal;
  if (cell.state == State::kOpen) return result;
  for (const CellId half : cell.halves) result.halves.push_back(written(half, chart, at_start));
  const Kind kind = result.halves[0].kind;
  if (kind == result.halves[1].kind && (kind == Kind::kStart || kind == Kind::kGoal)) {
    result.kind = kind;
    result.halves.clear();
    return result;
  }
  result.kind = Kind::kCut;
  result.axis = static_cast<std::uint32_t>(cell.axis);
  result.at = exact_rational(cell.box.middle()[cell.axis]);
  return result;
}

}  // namespace nef::planner
