// SPDX-License-Identifier: Apache-2.0
//
// The pair that overlaps deepest in the middle of a part decides how it is halved: across a coordinate or across an
// orientation, whichever loses more of that depth over the part, and along that the axis whose halves lose least.
//
// Parts do not know of each other, so some of those that wait are judged at once, on as many threads as there are.
#include "apps/planner/no_path/pose_cover.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "nef/base/threads/parallel.h"

namespace nef::planner {
namespace {

using Kind = PathProof::PoseCell::Kind;
using Pairs = std::vector<BlockingPairs::Pair>;

constexpr double kSmallest = 0x1p-16;  // parts of the robot's reach; what is shorter is not cut

// How many parts are judged at once, whatever the number of threads: the result depends on it. It begins with one and
// is doubled up to this, as the rest is in vain if one of them is open.
constexpr std::size_t kMostAtOnce = 32;

struct CoverPart {
  PositionBox box;
  OrientationBox<double> orientation;
  Pairs candidates;                          // that may meet in a part that this one is in
  std::shared_ptr<const TurnedRobot> robot;  // at all of the orientations; null: not made yet
  PathProof::PoseCell* cell = nullptr;
  std::size_t of = 0;  // which of the boxes it is a part of
};

// What came of a part.
struct JudgedPart {
  std::optional<OpenPose> open;
  bool is_counted = false;
  std::vector<CoverPart> halves;
};

OrientationBox<double> middle_of(const OrientationBox<double>& box) {
  OrientationBox<double> result = box;
  for (std::size_t k = 0; k < 3; ++k) result.low[k] = result.high[k] = (box.low[k] + box.high[k]) / 2;
  return result;
}

// A multiple of a power of two, within `slack` of x.
Rational short_number(double x, double slack) {
  const double unit = std::exp2(std::floor(std::log2(slack)));
  return exact_rational(std::round(x / unit) * unit);
}

Rational3 short_point(const Vector3d& v, double slack) {
  return {short_number(v[0], slack), short_number(v[1], slack), short_number(v[2], slack)};
}

class PartCover {
 public:
  PartCover(const BlockingPairs& pairs, std::size_t dimension) : pairs_(pairs), dimension_(dimension) {}

  // The cell of the part becomes blocked, beyond or cut, unless a pose in it is open.
  [[nodiscard]] JudgedPart judge(CoverPart part, const Monitor& monitor) const {
    JudgedPart result;
    PathProof::PoseCell& cell = *part.cell;
    if (part.robot == nullptr) part.robot = std::make_shared<const TurnedRobot>(pairs_.turned(part.orientation));
    keep_near(part);
    const auto [away, side] = pairs_.beyond(*part.robot, part.box);
    if (away > 0) {
      cell.kind = Kind::kBeyond;
      cell.side = side;
      return result;
    }
    const OrientationBox<double> turn = middle_of(part.orientation);
    const TurnedRobot middle = pairs_.turned(turn);
    const auto deepest = deepest_pair(part, middle, monitor);
    const bool middle_is_beyond = pairs_.beyond(middle, {part.box.middle(), part.box.middle()}).first > 0;
    if (!deepest && !middle_is_beyond) {
      result.open = {part.box.middle(), turn};
      return result;
    }
    result.is_counted = true;
    for (const BlockingPairs::Pair& pair : part.candidates) {
      monitor.check_interruption();
      cell.common = common_points(pairs_, pair, *part.robot, part.box.corners());
      if (cell.common.empty()) continue;
      cell.kind = Kind::kBlocked;
      cell.robot = pair[0];
      cell.obstacle = pair[1];
      return result;
    }
    double drifting = 0;
    if (deepest && drift_points(part, *deepest, cell, drifting)) return result;
    const std::uint32_t axis = choose(part, middle, deepest, drifting);
    if (width(part, axis) * (axis < 3 ? 1 : pairs_.reach()) < kSmallest * pairs_.reach()) {
      result.open = {part.box.middle(), turn};
      return result;
    }
    cell.kind = Kind::kCut;
    cell.axis = axis;
    cell.at = exact_rational(middle_of_axis(part, axis));
    cell.halves.resize(2);
    result.halves = halves_of(part);
    return result;
  }

  // Drops the pairs that do not meet in the part.
  void keep_near(CoverPart& part) const {
    std::erase_if(part.candidates, [&](const BlockingPairs::Pair& pair) { return !pairs_.may_meet(pair, part.box); });
  }

  // Those of a part whose cell is cut.
  static std::vector<CoverPart> halves_of(const CoverPart& part) {
    const std::uint32_t axis = part.cell->axis;
    const double at = middle_of_axis(part, axis);
    std::vector<CoverPart> halves(2, part);
    for (const bool upper : {false, true}) {
      CoverPart& half = halves[upper ? 1 : 0];
      half.cell = &part.cell->halves[upper ? 1 : 0];
      if (axis < 3) {
        (upper ? half.box.low : half.box.high)[axis] = at;
      } else {
        (upper ? half.orientation.low : half.orientation.high)[axis - 3] = at;
        half.robot = nullptr;
      }
    }
    return halves;
  }

 private:
  // The pair first that overlaps deepest in the middle of the part; the candidates in this order.
  std::optional<BlockingPairs::Pair> deepest_pair(CoverPart& part, const TurnedRobot& middle,
                                                  const Monitor& monitor) const {
    std::vector<std::pair<double, BlockingPairs::Pair>> depths;
    for (const BlockingPairs::Pair& pair : part.candidates) {
      monitor.check_interruption();
      depths.emplace_back(-pairs_.at(pair, middle, part.box.middle()).depth, pair);
    }
    std::sort(depths.begin(), depths.end());
    for (std::size_t i = 0; i < depths.size(); ++i) part.candidates[i] = depths[i].second;
    if (depths.empty() || depths.front().first >= -pairs_.resolution()) return std::nullopt;
    return depths.front().second;
  }

  // Whether points that drift show that the part is blocked by a pair; how deep it is in the middle.
  bool drift_points(const CoverPart& part, const BlockingPairs::Pair& pair, PathProof::PoseCell& cell,
                    double& depth) const {
    const auto corners = part.box.corners();
    const DriftingDepths found = pairs_.drifting_at_all(pair, *part.robot, part.box.middle(), corners);
    depth = found.middle;
    if (found.at.size() < corners.size()) return false;
    double least = HUGE_VAL;
    for (const CommonDepth& corner : found.at) least = std::min(least, corner.depth);
    // Four roundings add up.
    for (const CommonDepth& corner : found.at) cell.common.push_back(short_point(corner.point, least / 64));
    for (const Vector3d& way : found.drift) cell.drift.push_back(short_point(way, least / 64));
    cell.kind = Kind::kBlocked;
    cell.robot = pair[0];
    cell.obstacle = pair[1];
    return true;
  }

  // The axis to halve.
  [[nodiscard]] std::uint32_t choose(const CoverPart& part, const TurnedRobot& middle,
                                     const std::optional<BlockingPairs::Pair>& pair, double drifting) const {
    std::uint32_t widest = 3;
    for (std::uint32_t axis = 3; axis < 3 + dimension_; ++axis) {
      if (width(part, axis) > width(part, widest)) widest = axis;
    }
    if (!pair || part.robot->origins.empty()) return widest;
    // What is left of the depth at the ends of each coordinate.
    double least = HUGE_VAL;
    std::uint32_t position_axis = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        Vector3d at = part.box.middle();
        at[axis] = upper ? part.box.high[axis] : part.box.low[axis];
        const double depth = pairs_.at(*pair, middle, at).depth;
        if (depth > least || (depth == least && width(part, axis) <= width(part, position_axis))) continue;
        least = depth;
        position_axis = axis;
      }
    }
    const double turned = std::max(drifting, pairs_.at(*pair, *part.robot, part.box.middle()).depth);
    // A coordinate that is cut very finely does not help: what is lost is lost by turning.
    constexpr double kFine = 0x1p-6;
    const bool is_fine = width(part, position_axis) < kFine * width(part, widest) * pairs_.reach();
    return turned > least && !is_fine ? position_axis : best_turn(part, *pair, widest);
  }

  // The parameter whose halves keep most of the depth; the widest one if none keeps any.
  [[nodiscard]] std::uint32_t best_turn(const CoverPart& part, const BlockingPairs::Pair& pair,
                                        std::uint32_t widest) const {
    double most = 0;
    std::uint32_t best = widest;
    for (std::uint32_t axis = 3; dimension_ > 1 && axis < 3 + dimension_; ++axis) {
      if (width(part, axis) < width(part, widest) / 4) continue;
      double kept = 0;
      for (const bool upper : {false, true}) {
        OrientationBox<double> half = part.orientation;
        (upper ? half.low : half.high)[axis - 3] = (half.low[axis - 3] + half.high[axis - 3]) / 2;
        kept += pairs_.at(pair, pairs_.turned(half), part.box.middle()).depth;
      }
      if (kept <= most) continue;
      most = kept;
      best = axis;
    }
    return best;
  }

  static double width(const CoverPart& part, std::uint32_t axis) {
    if (axis < 3) return part.box.high[axis] - part.box.low[axis];
    return part.orientation.high[axis - 3] - part.orientation.low[axis - 3];
  }

  static double middle_of_axis(const CoverPart& part, std::uint32_t axis) {
    return axis < 3 ? part.box.middle()[axis] : (part.orientation.low[axis - 3] + part.orientation.high[axis - 3]) / 2;
  }

  const BlockingPairs& pairs_;
  std::size_t dimension_;
};

class Covering {
 public:
  Covering(const BlockingPairs& pairs, const Orientations& orientations,
           const std::vector<std::optional<ChartImage>>& images, std::span<const CoverTask> tasks)
      : cover_(pairs, orientations.dimension()), images_(images), tasks_(tasks), waiting_of_(tasks.size(), 0) {
    for (std::size_t i = tasks.size(); i-- > 0;) {
      std::vector<PathProof::PoseCell>& charts = *tasks[i].charts;
      charts.resize(images.size());
      for (auto chart = static_cast<std::uint32_t>(images.size()); chart-- > 0;) {
        if (images[chart]) continue;
        CoverPart part{tasks[i].box, {}, pairs.all(), nullptr, &charts[chart], i};
        part.orientation.chart = chart;
        add(std::move(part));
      }
    }
  }

  PoseCover run(std::size_t& budget, const Monitor& monitor) {
    PoseCover result;
    for (std::size_t at_once = 1; !waiting_.empty() && budget > 0 && !result.open;
         at_once = std::min(2 * at_once, kMostAtOnce)) {
      const std::size_t count = std::min({waiting_.size(), budget, at_once});
      const auto first = waiting_.end() - static_cast<std::ptrdiff_t>(count);
      const std::vector<CoverPart> parts(std::make_move_iterator(first), std::make_move_iterator(waiting_.end()));
      waiting_.erase(first, waiting_.end());
      std::vector<JudgedPart> judged(count);
      parallel_for(count, monitor, [&](std::size_t i, const Monitor& own) { judged[i] = cover_.judge(parts[i], own); });
      for (std::size_t i = 0; i < count; ++i) {
        if (judged[i].is_counted) --budget;
        if (judged[i].open) {  // the last one comes first
          result.open = judged[i].open;
          result.open_task = parts[i].of;
          continue;
        }
        --waiting_of_[parts[i].of];
        for (std::size_t half = judged[i].halves.size(); half-- > 0;) add(std::move(judged[i].halves[half]));
      }
    }
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      result.is_done.push_back(waiting_of_[i] == 0);
      if (waiting_of_[i] == 0) make_images(*tasks_[i].charts, monitor);
    }
    return result;
  }

 private:
  // The part has to wait, or what is left of it if it was cut before. A box that is not looked at yet is on no side; it
  // is of the kind that comes first.
  void add(CoverPart part) {
    if (part.cell->kind == Kind::kBlocked || part.cell->kind == Kind::kBeyond) return;
    if (part.cell->kind == Kind::kCut) {
      std::vector<CoverPart> halves = PartCover::halves_of(part);
      add(std::move(halves[1]));
      add(std::move(halves[0]));
      return;
    }
    ++waiting_of_[part.of];
    waiting_.push_back(std::move(part));
  }

  void make_images(std::vector<PathProof::PoseCell>& charts, const Monitor& monitor) const {
    for (std::size_t chart = 0; chart < charts.size(); ++chart) {
      if (images_[chart]) charts[chart] = image_of(charts[images_[chart]->of], *images_[chart], monitor);
    }
  }

  PartCover cover_;
  const std::vector<std::optional<ChartImage>>& images_;
  std::span<const CoverTask> tasks_;
  std::vector<CoverPart> waiting_;       // the next one is the last one
  std::vector<std::size_t> waiting_of_;  // how many of each box
};

}  // namespace

std::vector<Rational3> common_points(const BlockingPairs& pairs, const BlockingPairs::Pair& pair,
                                     const TurnedRobot& robot, std::span<const Vector3d> corners) {
  std::vector<Rational3> result;
  if (robot.pieces[pair[0]].normals.empty()) return result;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& corner : corners) middle += corner;
  middle /= static_cast<double>(corners.size());
  if (pairs.at(pair, robot, middle).depth <= pairs.resolution()) return result;
  const std::vector<CommonDepth> found = pairs.at_all(pair, robot, corners);
  if (found.size() < corners.size()) return result;
  for (const CommonDepth& corner : found) result.push_back(short_point(corner.point, corner.depth / 16));
  return result;
}

PoseCover cover_poses(const BlockingPairs& pairs, const Orientations& orientations,
                      const std::vector<std::optional<ChartImage>>& images, std::span<const CoverTask> tasks,
                      std::size_t& budget, const Monitor& monitor) {
  return Covering(pairs, orientations, images, tasks).run(budget, monitor);
}

}  // namespace nef::planner
