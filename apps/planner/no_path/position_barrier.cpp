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

#include "nef/base/threads/parallel.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

constexpr double kFree = 1e7;  // the effort of what is not blocked

}  // namespace

PositionBarrier::PositionBarrier(const PathProof::Claim& claim, const Orientations& orientations,
                                 const Rational3& reference, const Monitor& monitor)
    : orientations_(orientations),
      reference_(reference),
      images_(images_of_charts(claim, orientations, reference, monitor)),
      pairs_(claim, orientations, reference, monitor),
      graph_(claim, reference, pairs_.reach()) {
  add_samples();
  judge(std::array{graph_.add_root(pairs_.all())}, monitor);
}

// The corners, the middle and the middles of the octants of each chart that is no image of another one.
void PositionBarrier::add_samples() {
  std::vector<std::pair<std::uint32_t, std::array<double, 3>>> points;
  for (std::uint32_t chart = 0; chart < orientations_.charts().size(); ++chart) {
    if (images_[chart]) continue;
    points.push_back({chart, {0, 0, 0}});
    for (const double far : {1.0, 0.5}) {
      for (std::size_t i = 0; i < (std::size_t{1} << orientations_.dimension()); ++i) {
        std::array<double, 3> point{};
        for (std::size_t k = 0; k < orientations_.dimension(); ++k) point[k] = ((i >> k) & 1) != 0 ? far : -far;
        points.emplace_back(chart, point);
      }
    }
  }
  for (const auto& [chart, point] : points) {
    const bool is_special = std::fabs(point[0]) != 0.5;
    order_.push_back(static_cast<std::uint32_t>(samples_.size()));
    samples_.push_back({pairs_.turned({chart, point, point}), is_special ? 0.01 : 1});
  }
}

double PositionBarrier::depth(const BarrierCell& cell, const TurnedRobot& robot, const Vector3d& position,
                              const Monitor& monitor) const {
  double most = pairs_.beyond(robot, {position, position}).first;
  for (const BlockingPairs::Pair& pair : cell.pairs) {
    monitor.check_interruption();
    most = std::max(most, pairs_.at(pair, robot, position).depth);
  }
  return most;
}

// About how many ranges of orientations it takes to show that a position is blocked at all of them; infinite if it is
// free at one of the samples.
double PositionBarrier::effort_at(const BarrierCell& cell, const Vector3d& position, Order& order, FreeSamples& free,
                                  const Monitor& monitor) const {
  double effort = 0;
  double weights = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Sample& sample = samples_[order[i]];
    const double deep = depth(cell, sample.robot, position, monitor);
    if (deep <= pairs_.resolution()) {
      free.push_back(order[i]);
      move_forward(order, i);
      return HUGE_VAL;
    }
    const double ranges = std::pow(pairs_.reach() / deep, static_cast<double>(orientations_.dimension()) / 2);
    effort += sample.weight * ranges;
    weights += sample.weight;
  }
  return effort / weights;
}

// Each cell is judged by the samples in the order that is known before, so threads need not wait for each other.
void PositionBarrier::judge(std::span<const CellId> ids, const Monitor& monitor) {
  judged_.resize(graph_.size());
  std::vector<FreeSamples> free(ids.size());
  parallel_for(ids.size(), monitor, [&](std::size_t i, const Monitor& own) {
    Order order = order_;
    judge(ids[i], order, free[i], own);
  });
  for (const FreeSamples& samples : free) {
    for (const std::uint32_t sample : samples) {
      move_forward(order_, static_cast<std::size_t>(std::find(order_.begin(), order_.end(), sample) - order_.begin()));
    }
  }
}

void PositionBarrier::judge(CellId id, Order& order, FreeSamples& free, const Monitor& monitor) {
  BarrierCell& cell = graph_[id];
  Judged& judged = judged_[id];
  std::erase_if(cell.pairs, [&](const BlockingPairs::Pair& pair) { return !pairs_.may_meet(pair, cell.box); });
  judged.effort = effort_at(cell, cell.box.middle(), order, free, monitor);
  judged.is_blocked = judged.effort < HUGE_VAL;
  const bool is_small = (cell.box.high - cell.box.low).maxCoeff() < pairs_.reach() / 512;
  const bool is_free = cell.pairs.empty() && (!graph_.is_bounded() || is_zero(reference_));
  cell.is_hopeless = !judged.is_blocked && (is_free || is_small);
  choose_axis(cell, judged, order, free, monitor);
  weigh(id);
}

void PositionBarrier::weigh(CellId id) {
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
void PositionBarrier::choose_axis(BarrierCell& cell, Judged& judged, Order& order, FreeSamples& free,
                                  const Monitor& monitor) const {
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
      const double effort = effort_at(cell, at, order, free, monitor);
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

// Covers boxes; if a pose in one is open, that is a sample from now on. False if the budget is used up.
bool PositionBarrier::cover(std::vector<CellId> ids, std::size_t& budget, const Monitor& monitor) {
  // The hardest one first.
  std::sort(ids.begin(), ids.end(), [&](CellId a, CellId b) { return judged_[a].effort > judged_[b].effort; });
  std::vector<CoverTask> tasks;
  for (const CellId id : ids) tasks.push_back({graph_[id].box, &graph_[id].blocked});
  const PoseCover found = cover_poses(pairs_, orientations_, images_, tasks, budget, monitor);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (found.is_done[i]) graph_[ids[i]].state = BarrierCell::State::kBlocked;
  }
  if (!found.open) return budget > 0;
  graph_[ids[found.open_task]].blocked.clear();
  if (budget == 0) return false;
  add_open(ids[found.open_task], *found.open, budget, monitor);
  return true;
}

// A pose in a cell is open: boxes that look blocked are judged anew if it shows that they are not.
void PositionBarrier::add_open(CellId id, const OpenPose& open, std::size_t& budget, const Monitor& monitor) {
  order_.insert(order_.begin(), static_cast<std::uint32_t>(samples_.size()));
  samples_.push_back({pairs_.turned(open.orientation), 1});
  std::vector<CellId> others;
  for (CellId other = 0; other < graph_.size(); ++other) {
    if (graph_[other].state == BarrierCell::State::kOpen && judged_[other].is_blocked) others.push_back(other);
  }
  std::vector<char> is_wrong(others.size(), 0);
  constexpr std::size_t kCellsAtOnce = 16;
  parallel_for_ranges(
      others.size(), kCellsAtOnce, monitor, [&](std::size_t first, std::size_t last, const Monitor& own) {
        for (std::size_t i = first; i < last; ++i) {
          const BarrierCell& cell = graph_[others[i]];
          is_wrong[i] = depth(cell, samples_.back().robot, cell.box.middle(), own) <= pairs_.resolution() ? 1 : 0;
        }
      });
  std::vector<CellId> wrong;
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (is_wrong[i] != 0) wrong.push_back(others[i]);
  }
  judge(wrong, monitor);
  budget -= std::min(budget, graph_.size() / 4);
  // It is cut towards the open pose.
  if (!judged_[id].is_settled) return;
  judged_[id].is_settled = false;
  BarrierCell& cell = graph_[id];
  Eigen::Index axis = 0;
  ((open.position - cell.box.middle()).array().abs() / (cell.box.high - cell.box.low).array()).maxCoeff(&axis);
  cell.axis = static_cast<std::uint32_t>(axis);
  weigh(id);
}

// One round; false if nothing is left to be done.
bool PositionBarrier::advance(std::size_t& budget, const Monitor& monitor) {
  const std::vector<CellId> cells = graph_.cheapest_barrier(monitor);
  if (cells.empty()) return false;
  std::vector<CellId> halves;
  for (const CellId id : cells) {
    if (judged_[id].is_settled || budget == 0) continue;
    for (const CellId half : graph_.cut(id)) halves.push_back(half);
    --budget;
  }
  judge(halves, monitor);
  if (!halves.empty()) return budget > 0;
  return cover(cells, budget, monitor);
}

std::optional<std::size_t> PositionBarrier::boxes_left() const {
  double effort = 0;
  for (const CellId id : graph_.in_question()) {
    if (graph_[id].state == BarrierCell::State::kBlocked) continue;
    if (!judged_[id].is_blocked) return std::nullopt;
    effort += 1 + judged_[id].effort;
  }
  if (graph_.in_question().empty() || effort >= kFree) return std::nullopt;
  return static_cast<std::size_t>(effort);
}

std::vector<PositionBox> PositionBarrier::in_question() const {
  std::vector<PositionBox> result;
  for (const CellId id : graph_.in_question()) {
    if (graph_[id].state != BarrierCell::State::kBlocked) result.push_back(graph_[id].box);
  }
  return result;
}

bool PositionBarrier::find(std::size_t& budget, const Monitor& monitor) {
  while (advance(budget, monitor)) {
    monitor.check_interruption();
    budget -= std::min(budget, graph_.size() / 32);  // for the graph
  }
  return graph_.is_found();
}

}  // namespace nef::planner
