// SPDX-License-Identifier: Apache-2.0
//
// 1. A box is judged by the pose in its middle. Pairs of pieces that are farther apart there than any point of the
//    robot moves within the box are never in the way; if none is left, all of the box is free. If a pair overlaps at
//    all corners of the box, by the inner piece of all its angles, the box is blocked.
// 2. In the graph of the other boxes (barrier_graph.h), those that are blocked in the middle weigh about as much as the
//    parts it takes to block them all; others weigh more than any of these.
// 3. The boxes of the cheapest barrier are halved along the axis along which the depth of the overlap changes most, and
//    judged, until nothing is left of it: then all ways from start to goal meet blocked boxes.
// The number of boxes grows with the third power of the robot's size over the barrier's thickness, less where pieces
// are long along an axis.
#include "apps/planner/no_path/pose_barrier.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/planner/no_path/pose_cover.h"
#include "nef/base/error.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using Kind = PathProof::PoseCell::Kind;
constexpr std::uint32_t kAngle = BarrierGraph::kAngle;

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
      reference_reach_(to_vector(reference).norm()),
      graph_(claim, reference, pairs_.reach(), {end_of(claim.path.front()), end_of(claim.path.back())},
             orientations.seams().size() == orientations.charts().size() ? orientations.charts().size() : 0) {
  NEF_ASSERT(orientations.dimension() == 1);
  for (std::uint32_t chart = 0; chart < orientations.charts().size(); ++chart) {
    graph_.add_root(chart, pairs_.all(), [&](CellId id) { judge(graph_[id]); });
  }
}

BarrierGraph::End PoseBarrier::end_of(const RigidPose& pose) const {
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

double PoseBarrier::depth(const BarrierCell& cell, const TurnedRobot& robot, const Vector3d& position) const {
  double most = std::max(-4 * pairs_.reach(), pairs_.beyond(robot, {position, position}).first);
  for (const BlockingPairs::Pair& pair : cell.pairs)
    most = std::max(most, pairs_.at(pair, robot, position, most).depth);
  return most;
}

void PoseBarrier::judge(BarrierCell& cell) {
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
    PathProof::PoseCell shown;
    bool is_blocked = away > 0;
    if (is_blocked) {
      shown.kind = Kind::kBeyond;
      shown.side = beyond;
    }
    for (const auto& [negative, pair] : depths) {
      if (is_blocked || -negative <= pairs_.resolution()) break;
      is_blocked = is_blocked_by(pairs_, pair, robot, cell.box, shown);
    }
    if (is_blocked) {
      cell.state = BarrierCell::State::kBlocked;
      cell.blocked = {std::move(shown)};
      return;
    }
  }
  cell.is_hopeless = std::max(way, pairs_.reach() * angle) < kSmallest * pairs_.reach();
  if (!cell.is_hopeless) weigh(cell, middle, deepest, angle);
}

// The weight of a box, and the axis along which it is cut: the one along which the overlap becomes least; of a box that
// is free in the middle the one along which it becomes largest, or the longest one.
void PoseBarrier::weigh(BarrierCell& cell, const TurnedRobot& middle, double deepest, double angle) {
  const bool is_blocked = deepest > pairs_.resolution();
  double parts = 1;
  double across = 1;  // a barrier needs no parts one after the other across it
  double best = -HUGE_VAL;
  for (std::uint32_t axis = 0; axis <= kAngle; ++axis) {
    if (axis < kAngle && graph_.bounds().is_flat[axis]) continue;
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

// One round; false if nothing is left to be done.
bool PoseBarrier::advance(std::size_t& budget) {
  const std::vector<CellId> cells = graph_.cheapest_barrier();
  if (cells.empty()) return false;
  for (const CellId id : cells) {
    if (budget == 0) return false;
    graph_.cut(id, [&](CellId half) { judge(graph_[half]); });
    --budget;
  }
  return budget > 0;
}

bool PoseBarrier::find(std::size_t& budget) {
  while (advance(budget)) {
    monitor_.check_interruption();
    budget -= std::min(budget, graph_.size() / 512);  // for the graph
  }
  return graph_.is_found();
}

}  // namespace nef::planner
