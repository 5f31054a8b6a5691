// SPDX-License-Identifier: Apache-2.0
//
// 1. A box is judged by the pose in its middle. Pairs of pieces that are farther apart there than any point of the
// robot
//    moves within the box are never in the way; if none is left, all of the box is free. If a pair overlaps at all
//    corners of the box, by the inner piece of all its angles, the box is blocked.
// 2. The minimum cut between start and goal in the graph of the other boxes is where a barrier seems to be cheapest.
//    Boxes that are blocked in the middle weigh about as much as the parts it takes to block them all; others weigh
//    more than any of these.
// 3. The boxes of the cut are halved along the axis along which the depth of the overlap changes most, and judged,
// until
//    nothing is left of the cut: then all ways from start to goal meet blocked boxes.
// The number of boxes grows with the third power of the robot's size over the barrier's thickness, less where pieces
// are long along an axis.
#include "apps/planner/no_path/pose_barrier.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/planner/no_path/minimum_cut.h"
#include "apps/planner/no_path/pose_cover.h"
#include "nef/base/error.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using Kind = PathProof::PoseCell::Kind;

OrientationBox<double> at_parameter(const OrientationBox<double>& orientation, double parameter) {
  OrientationBox<double> result = orientation;
  result.low[0] = result.high[0] = parameter;
  return result;
}

double middle_parameter(const OrientationBox<double>& orientation) {
  return (orientation.low[0] + orientation.high[0]) / 2;
}

}  // namespace

PoseBarrier::PoseBarrier(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference,
                         const Monitor& monitor)
    : orientations_(orientations),
      reference_(reference),
      pairs_(claim, orientations, reference),
      monitor_(monitor),
      is_bounded_(claim.box.has_value()),
      bounds_(claim, reference, pairs_.reach()),
      reference_reach_(to_vector(reference).norm()),
      ends_{end_of(claim.path.front()), end_of(claim.path.back())} {
  NEF_ASSERT(orientations.dimension() == 1);
  const auto charts = static_cast<std::uint32_t>(orientations.charts().size());
  is_closed_ = orientations.seams().size() == charts;
  cells_.emplace_back().is_hopeless = true;  // outside
  cells_.front().weight = WeightedGraph::kUncuttable;
  for (std::uint32_t chart = 0; chart < charts; ++chart) {
    Cell all;
    all.box = bounds_.rough;
    all.orientation.chart = chart;
    all.pairs = pairs_.all();
    judge(all);
    cells_.push_back(std::move(all));
    for (CellId other = 0; other <= chart; ++other) link(other, chart + 1);
  }
}

PoseBarrier::End PoseBarrier::end_of(const RigidPose& pose) const {
  const auto at = orientations_.locate(pose.quaternion);
  NEF_ASSERT(at.has_value());
  return {reference_position(pose, reference_), at->chart, nearest_double(at->low[0])};
}

// How far the robot is turned from the middle of a box at most.
double PoseBarrier::half_angle(const OrientationBox<double>& orientation) const {
  const Orientations::Chart& chart = orientations_.charts()[orientation.chart];
  const auto at = [&](double t) {
    Eigen::Vector4d q;
    for (std::size_t k = 0; k < 4; ++k) {
      q[static_cast<Eigen::Index>(k)] = nearest_double(chart.origin[k]) + t * nearest_double(chart.directions[0][k]);
    }
    return q.normalized();
  };
  const Eigen::Vector4d middle = at(middle_parameter(orientation));
  double most = 0;
  for (const double t : {orientation.low[0], orientation.high[0]}) {
    const Eigen::Vector4d q = at(t);
    // The angle between quaternions is half of that between rotations.
    most = std::max(most, 4 * std::atan2((q - middle).norm(), (q + middle).norm()));
  }
  return most;
}

double PoseBarrier::depth(const Cell& cell, const TurnedRobot& robot, const Vector3d& position) const {
  double most = std::max(-4 * pairs_.reach(), pairs_.beyond(robot, {position, position}).first);
  for (const BlockingPairs::Pair& pair : cell.pairs)
    most = std::max(most, pairs_.at(pair, robot, position, most).depth);
  return most;
}

void PoseBarrier::judge(Cell& cell) {
  monitor_.check_interruption();
  const Vector3d at = cell.box.middle();
  const TurnedRobot middle = pairs_.turned(at_parameter(cell.orientation, middle_parameter(cell.orientation)));
  const double way = (cell.box.high - cell.box.low).norm() / 2;
  const double angle = half_angle(cell.orientation);
  const double side = pairs_.beyond(middle, {at, at}).first;
  std::vector<std::pair<double, BlockingPairs::Pair>> depths;
  for (const BlockingPairs::Pair& pair : cell.pairs) {
    if (!pairs_.may_meet(pair, cell.box)) continue;
    const double moves = way + pairs_.reach(pair[0]) * angle + pairs_.resolution();
    const double deep = pairs_.at(pair, middle, at, -moves).depth;
    if (deep > -moves) depths.emplace_back(-deep, pair);
  }
  std::sort(depths.begin(), depths.end());
  cell.pairs.clear();
  for (const auto& entry : depths) cell.pairs.push_back(entry.second);
  const bool is_beyond_somewhere = side > -(way + reference_reach_ * angle + pairs_.resolution());
  cell.weight = WeightedGraph::kUncuttable;
  cell.is_hopeless = cell.pairs.empty() && !is_beyond_somewhere;
  if (cell.is_hopeless) return;
  const double deepest = std::max(side, depths.empty() ? -HUGE_VAL : -depths.front().first);
  if (deepest > pairs_.resolution()) {
    const TurnedRobot robot = pairs_.turned(cell.orientation);
    const auto [away, beyond] = pairs_.beyond(robot, cell.box);
    if (away > 0) {
      cell.state = State::kBlocked;
      cell.blocked.kind = Kind::kBeyond;
      cell.blocked.side = beyond;
      return;
    }
    for (const auto& [negative, pair] : depths) {
      if (-negative <= pairs_.resolution()) break;
      if (!is_blocked_by(pairs_, pair, robot, cell.box, cell.blocked)) continue;
      cell.state = State::kBlocked;
      return;
    }
  }
  cell.is_hopeless = std::max(way, pairs_.reach() * angle) < kSmallest * pairs_.reach();
  if (!cell.is_hopeless) weigh(cell, middle, deepest, angle);
}

// The weight of a box, and the axis along which it is cut: the one along which the overlap becomes least; of a box that
// is free in the middle the one along which it becomes largest, or the longest one.
void PoseBarrier::weigh(Cell& cell, const TurnedRobot& middle, double deepest, double angle) {
  const bool is_blocked = deepest > pairs_.resolution();
  double parts = 1;
  double across = 1;  // a barrier needs no parts one after the other across it
  double best = -HUGE_VAL;
  for (std::uint32_t axis = 0; axis <= kAngle; ++axis) {
    if (axis < kAngle && bounds_.is_flat[axis]) continue;
    const auto k = static_cast<Eigen::Index>(axis);
    const double width = axis == kAngle ? 2 * angle * pairs_.reach() : cell.box.high[k] - cell.box.low[k];
    if (width < kSmallest * pairs_.reach()) continue;
    std::array<double, 2> depths{};
    for (std::size_t end = 0; end < 2; ++end) {
      Vector3d at = cell.box.middle();
      if (axis < kAngle) {
        at[k] = end == 0 ? cell.box.low[k] : cell.box.high[k];
        depths[end] = depth(cell, middle, at);
      } else {
        const double t = end == 0 ? cell.orientation.low[0] : cell.orientation.high[0];
        depths[end] = depth(cell, pairs_.turned(at_parameter(cell.orientation, t)), at);
      }
    }
    const auto [least, most] = std::minmax(depths[0], depths[1]);
    double rank = 0;
    if (is_blocked) {
      const double loss = std::max(deepest - least, 0.0) / deepest;
      rank = loss + 0x1p-6 * width / pairs_.reach();
      parts *= std::max(1.0, loss);
      across = std::max(across, loss);
    } else {
      rank = width / pairs_.reach() * (most > pairs_.resolution() ? 2 : 1);
    }
    if (rank <= best) continue;
    best = rank;
    cell.axis = axis;
  }
  if (best == -HUGE_VAL) {
    cell.is_hopeless = true;
    return;
  }
  cell.weight = static_cast<std::int64_t>(16 * (is_blocked ? std::min(kFree / 10, parts / across) : kFree));
}

PoseBarrier::CellId PoseBarrier::cell_of(const End& end) const {
  if (!bounds_.rough.has(end.position)) return kOutside;
  CellId id = end.chart + 1;
  while (cells_[id].state == State::kCut) {
    const Cell& lower = cells_[cells_[id].halves[0]];
    const bool is_lower = lower.box.has(end.position) && end.parameter <= lower.orientation.high[0];
    id = cells_[id].halves[is_lower ? 0 : 1];
  }
  return id;
}

void PoseBarrier::link(CellId a, CellId b) {
  if (cells_[a].state == State::kBlocked || cells_[b].state == State::kBlocked) return;
  const Cell& first = cells_[a];
  const Cell& second = cells_[b];
  if (std::min(a, b) == kOutside) {
    if (is_bounded_) return;
    const PositionBox& box = a == kOutside ? second.box : first.box;
    const PositionBox& all = bounds_.rough;
    if ((box.low.array() != all.low.array()).all() && (box.high.array() != all.high.array()).all()) return;
  } else {
    int touching = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double gap =
          std::max(first.box.low[k], second.box.low[k]) - std::min(first.box.high[k], second.box.high[k]);
      if (gap > 0) return;
      if (gap == 0) ++touching;
    }
    // Angles as numbers that go on from chart to chart, two for each.
    const auto span = [](const OrientationBox<double>& box) {
      return std::array{2.0 * box.chart + box.low[0], 2.0 * box.chart + box.high[0]};
    };
    const auto [low, high] = span(first.orientation);
    const auto [other_low, other_high] = span(second.orientation);
    double gap = std::max(low, other_low) - std::min(high, other_high);
    if (gap > 0 && is_closed_) {
      const double circle = 2.0 * static_cast<double>(orientations_.charts().size());
      if (std::max(high, other_high) - std::min(low, other_low) == circle) gap = 0;
    }
    if (gap > 0) return;
    if (gap == 0) ++touching;
    if (touching != 1) return;
  }
  cells_[a].neighbours.push_back(b);
  cells_[b].neighbours.push_back(a);
}

void PoseBarrier::cut(CellId id) {
  const auto first = static_cast<CellId>(cells_.size());
  for (const bool upper : {false, true}) {
    Cell half;
    half.box = cells_[id].box;
    half.orientation = cells_[id].orientation;
    half.pairs = cells_[id].pairs;
    const std::uint32_t axis = cells_[id].axis;
    if (axis == kAngle) {
      (upper ? half.orientation.low : half.orientation.high)[0] = middle_parameter(cells_[id].orientation);
    } else {
      const auto k = static_cast<Eigen::Index>(axis);
      (upper ? half.box.low : half.box.high)[k] = cells_[id].box.middle()[k];
    }
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

// One round; false if nothing is left to be done.
bool PoseBarrier::advance(std::size_t& budget) {
  WeightedGraph graph;
  for (const Cell& cell : cells_) {
    graph.weights.push_back(cell.weight);
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
      if (!cells_[end].is_hopeless && std::find(found.nodes.begin(), found.nodes.end(), end) == found.nodes.end()) {
        found.nodes.push_back(end);
      }
    }
    if (found.nodes.empty()) return false;
  }
  for (const CellId id : found.nodes) {
    if (budget == 0) return false;
    cut(id);
    --budget;
  }
  return budget > 0;
}

bool PoseBarrier::find(std::size_t& budget) {
  while (advance(budget)) {
    monitor_.check_interruption();
    budget -= std::min(budget, cells_.size() / 512);  // for the graph
  }
  return is_found_;
}

std::vector<bool> PoseBarrier::reached() const {
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

PathProof::PoseCells PoseBarrier::written() const {
  NEF_ASSERT(is_found_);
  PathProof::PoseCells result;
  result.reference = reference_;
  result.bounds = bounds_.exact;
  const std::vector<bool> at_start = reached();
  result.outside_at_start = at_start[kOutside];
  for (CellId chart = 1; chart <= orientations_.charts().size(); ++chart) {
    result.charts.push_back(written(chart, at_start));
  }
  return result;
}

PathProof::PoseCell PoseBarrier::written(CellId id, const std::vector<bool>& at_start) const {
  const Cell& cell = cells_[id];
  if (cell.state == State::kBlocked) return cell.blocked;
  PathProof::PoseCell result;
  result.kind = at_start[id] ? Kind::kStart : Kind::kGoal;
  if (cell.state == State::kOpen) return result;
  for (const CellId half : cell.halves) result.halves.push_back(written(half, at_start));
  const Kind kind = result.halves[0].kind;
  if (kind == result.halves[1].kind && (kind == Kind::kStart || kind == Kind::kGoal)) {
    result.kind = kind;
    result.halves.clear();
    return result;
  }
  result.kind = Kind::kCut;
  result.axis = cell.axis;
  result.at = exact_rational(cell.axis == kAngle ? middle_parameter(cell.orientation)
                                                 : cell.box.middle()[static_cast<Eigen::Index>(cell.axis)]);
  return result;
}

}  // namespace nef::planner
