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

#include "apps/planner/no_path/pose_cover.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
PositionBarrier::PositionBarrier(const PathProof::Claim& claim, const Orientations& orientations,
                                 const Rational3& reference, const Monitor& monitor)
    : orientations_(orientations),
      reference_(reference),
      images_(images_of_charts(claim, orientations, reference)),
      pairs_(claim, orientations, reference),
      monitor_(monitor),
      graph_(claim, reference, pairs_.reach()) {
  add_samples();
  graph_.add_root(pairs_.all(), [&](CellId id) { judge(id); });
}

// The corners, the middle and the middles of the octants of each chart that is no image of another one.
void PositionBarrier::add_samples() {
  for (std::uint32_t chart = 0; chart < orientations_.charts().size(); ++chart) {
    if (images_[chart]) continue;
    std::vector<std::array<double, 3>> points{{0, 0, 0}};
    for (const double far : {1.0, 0.5}) {
      for (std::size_t i = 0; i < (std::size_t{1} << orientations_.dimension()); ++i) {
        std::array<double, 3> point{};
        for (std::size_t k = 0; k < orientations_.dimension(); ++k) point[k] = ((i >> k) & 1) != 0 ? far : -far;
        points.push_back(point);
      }
    }
    for (const std::array<double, 3>& point : points) {
      const bool is_special = std::fabs(point[0]) != 0.5;
      samples_.push_back({pairs_.turned({chart, point, point}), is_special ? 0.01 : 1});
    }
  }
}

double PositionBarrier::depth(const BarrierCell& cell, const TurnedRobot& robot, const Vector3d& position) const {
  double most = pairs_.beyond(robot, {position, position}).first;
  for (const BlockingPairs::Pair& pair : cell.pairs) most = std::max(most, pairs_.at(pair, robot, position).depth);
  return most;
}

// About how many ranges of orientations it takes to show that a position is blocked at all of them; infinite if it is
// free at one of the samples.
double PositionBarrier::effort_at(const BarrierCell& cell, const Vector3d& position) {
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

void PositionBarrier::judge(CellId id) {
  monitor_.check_interruption();
  judged_.resize(std::max(judged_.size(), graph_.size()));
  BarrierCell& cell = graph_[id];
  Judged& judged = judged_[id];
  std::erase_if(cell.pairs, [&](const BlockingPairs::Pair& pair) { return !pairs_.may_meet(pair, cell.box); });
  judged.effort = effort_at(cell, cell.box.middle());
  judged.is_blocked = judged.effort < HUGE_VAL;
  const bool is_small = (cell.box.high - cell.box.low).maxCoeff() < pairs_.reach() / 512;
  const bool is_free = cell.pairs.empty() && (!graph_.is_bounded() || is_zero(reference_));
  cell.is_hopeless = !judged.is_blocked && (is_free || is_small);
  choose_axis(cell, judged);
  weigh(id);
}

void PositionBarrier::weigh(CellId id) {
  constexpr double kFree = 1e7;
  constexpr double kUnsettled = 4;
  if (graph_[id].is_hopeless) {
    graph_[id].weight = WeightedGraph::kUncuttable;
    return;
  }
  const Judged& judged = judged_[id];
  const double effort =
      judged.is_blocked ? std::min(kFree / 10, 1 + judged.effort * (judged.is_settled ? 1 : kUnsettled)) : kFree;
  graph_[id].weight = static_cast<std::int64_t>(16 * effort);
}

// The axis along which the effort differs most between the middles of facets and that of the box, and whether it is low
// everywhere; the longest axis if nothing is blocked.
void PositionBarrier::choose_axis(BarrierCell& cell, Judged& judged) {
  constexpr double kMuchMore = 1.15;
  const double size = (cell.box.high - cell.box.low).maxCoeff();
  judged.is_settled = judged.is_blocked;
  double best = -1;
  for (Eigen::Index axis = 0; !cell.is_hopeless && axis < 3; ++axis) {
    if (graph_.bounds().is_flat[static_cast<std::size_t>(axis)]) continue;
    const double width = cell.box.high[axis] - cell.box.low[axis];
    double rank = width / size;
    for (const bool upper : {false, true}) {
      Vector3d at = cell.box.middle();
      at[axis] = upper ? cell.box.high[axis] : cell.box.low[axis];
      const double effort = effort_at(cell, at);
      if (judged.is_blocked && effort > kMuchMore * judged.effort &&
          (effort == HUGE_VAL || width > pairs_.reach() / 16)) {
        judged.is_settled = false;
        rank += effort == HUGE_VAL ? 2 : 1;
      }
      if (!judged.is_blocked && effort < HUGE_VAL) rank += 2;
    }
    if (rank <= best) continue;
    best = rank;
    cell.axis = static_cast<std::uint32_t>(axis);
  }
}

// Covers a box; if a pose in it is open, that is a sample from now on.
bool PositionBarrier::cover(CellId id, std::size_t& budget) {
  PoseCover found = cover_poses(pairs_, orientations_, images_, graph_[id].box, budget, monitor_);
  if (!found.open) {
    graph_[id].state = BarrierCell::State::kBlocked;
    graph_[id].blocked = std::move(found.charts);
    return true;
  }
  if (budget == 0) return false;
  samples_.insert(samples_.begin(), {pairs_.turned(found.open->orientation), 1});
  for (CellId other = 0; other < graph_.size(); ++other) {
    const BarrierCell& cell = graph_[other];
    if (cell.state != BarrierCell::State::kOpen || !judged_[other].is_blocked) continue;
    if (depth(cell, samples_.front().robot, cell.box.middle()) <= pairs_.resolution()) judge(other);
  }
  budget -= std::min(budget, graph_.size() / 4);
  // It is cut towards the open pose.
  if (judged_[id].is_settled) {
    judged_[id].is_settled = false;
    BarrierCell& cell = graph_[id];
    Eigen::Index axis = 0;
    ((found.open->position - cell.box.middle()).array().abs() / (cell.box.high - cell.box.low).array()).maxCoeff(&axis);
    cell.axis = static_cast<std::uint32_t>(axis);
    weigh(id);
  }
  return true;
}

// One round; false if nothing is left to be done.
bool PositionBarrier::advance(std::size_t& budget) {
  std::vector<CellId> cells = graph_.cheapest_barrier();
  if (cells.empty()) return false;
  bool any = false;
  for (const CellId id : cells) {
    if (judged_[id].is_settled || budget == 0) continue;
    graph_.cut(id, [&](CellId half) { judge(half); });
    --budget;
    any = true;
  }
  if (any) return budget > 0;
  // The hardest one first.
  std::sort(cells.begin(), cells.end(), [&](CellId a, CellId b) { return judged_[a].effort > judged_[b].effort; });
  for (const CellId id : cells) {
    if (!cover(id, budget)) return false;
    if (graph_[id].state != BarrierCell::State::kBlocked) break;
  }
  return true;
}

bool PositionBarrier::find(std::size_t& budget) {
  while (advance(budget)) {
    monitor_.check_interruption();
    budget -= std::min(budget, graph_.size() / 32);  // for the graph
  }
  return graph_.is_found();
}

}  // namespace nef::planner
