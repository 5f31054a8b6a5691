// SPDX-License-Identifier: Apache-2.0
//
// The pair that overlaps deepest in the middle of a part decides how it is halved: across a coordinate or across an
// orientation, whichever loses more of that depth over the part, and along that the axis whose halves lose least.
#include "apps/planner/no_path/pose_cover.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nef::planner {
namespace {

using Kind = PathProof::PoseCell::Kind;
using Pairs = std::vector<BlockingPairs::Pair>;

constexpr double kSmallest = 0x1p-16;  // parts of the robot's reach; what is shorter is not cut

struct CoverPart {
  PositionBox box;
  OrientationBox<double> orientation;
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

class Covering {
 public:
  Covering(const BlockingPairs& pairs, const Orientations& orientations, std::size_t& budget, const Monitor& monitor)
      : pairs_(pairs), dimension_(orientations.dimension()), budget_(budget), monitor_(monitor) {}

  // False if a pose of the part is open.
  bool cover(const CoverPart& part, const TurnedRobot& robot, Pairs candidates, PathProof::PoseCell& cell) {
    monitor_.check_interruption();
    std::erase_if(candidates, [&](const BlockingPairs::Pair& pair) { return !pairs_.may_meet(pair, part.box); });
    const auto [away, side] = pairs_.beyond(robot, part.box);
    if (away > 0) {
      cell.kind = Kind::kBeyond;
      cell.side = side;
      return true;
    }
    const OrientationBox<double> turn = middle_of(part.orientation);
    const TurnedRobot middle = pairs_.turned(turn);
    const auto deepest = deepest_pair(part, middle, candidates);
    const bool middle_is_beyond = pairs_.beyond(middle, {part.box.middle(), part.box.middle()}).first > 0;
    if ((!deepest && !middle_is_beyond) || budget_ == 0) {
      open_ = {part.box.middle(), turn};
      return false;
    }
    --budget_;
    for (const BlockingPairs::Pair& pair : candidates) {
      cell.common = common_points(pairs_, pair, robot, part.box.corners());
      if (cell.common.empty()) continue;
      cell.kind = Kind::kBlocked;
      cell.robot = pair[0];
      cell.obstacle = pair[1];
      return true;
    }
    const std::uint32_t axis = choose(part, robot, middle, deepest);
    if (width(part, axis) * (axis < 3 ? 1 : pairs_.reach()) < kSmallest * pairs_.reach()) {
      open_ = {part.box.middle(), turn};
      return false;
    }
    return cut(part, robot, candidates, cell, axis);
  }

  [[nodiscard]] const std::optional<OpenPose>& open() const { return open_; }

 private:
  // The pair first that overlaps deepest in the middle of the part; the candidates in this order.
  std::optional<BlockingPairs::Pair> deepest_pair(const CoverPart& part, const TurnedRobot& middle,
                                                  Pairs& candidates) const {
    std::vector<std::pair<double, BlockingPairs::Pair>> depths;
    for (const BlockingPairs::Pair& pair : candidates) {
      depths.emplace_back(-pairs_.at(pair, middle, part.box.middle()).depth, pair);
    }
    std::sort(depths.begin(), depths.end());
    for (std::size_t i = 0; i < depths.size(); ++i) candidates[i] = depths[i].second;
    if (depths.empty() || depths.front().first >= -pairs_.resolution()) return std::nullopt;
    return depths.front().second;
  }

  // The axis to halve.
  [[nodiscard]] std::uint32_t choose(const CoverPart& part, const TurnedRobot& robot, const TurnedRobot& middle,
                                     const std::optional<BlockingPairs::Pair>& pair) const {
    std::uint32_t widest = 3;
    for (std::uint32_t axis = 3; axis < 3 + dimension_; ++axis) {
      if (width(part, axis) > width(part, widest)) widest = axis;
    }
    if (!pair || robot.origins.empty()) return widest;
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
    const double turned = pairs_.at(*pair, robot, part.box.middle()).depth;
    return turned > least ? position_axis : best_turn(part, *pair, widest);
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

  bool cut(const CoverPart& part, const TurnedRobot& robot, const Pairs& candidates, PathProof::PoseCell& cell,
           std::uint32_t axis) {
    const double at =
        axis < 3 ? part.box.middle()[axis] : (part.orientation.low[axis - 3] + part.orientation.high[axis - 3]) / 2;
    cell.kind = Kind::kCut;
    cell.axis = axis;
    cell.at = exact_rational(at);
    cell.halves.resize(2);
    for (const bool upper : {false, true}) {
      CoverPart half = part;
      if (axis < 3) {
        (upper ? half.box.low : half.box.high)[axis] = at;
      } else {
        (upper ? half.orientation.low : half.orientation.high)[axis - 3] = at;
      }
      PathProof::PoseCell& below = cell.halves[upper ? 1 : 0];
      const bool covered = axis < 3 ? cover(half, robot, candidates, below)
                                    : cover(half, pairs_.turned(half.orientation), candidates, below);
      if (!covered) return false;
    }
    return true;
  }

  const BlockingPairs& pairs_;
  std::size_t dimension_;
  std::size_t& budget_;
  Monitor monitor_;
  std::optional<OpenPose> open_;
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
  for (const CommonDepth& corner : found) {
    Rational3& point = result.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      point[k] = short_number(corner.point[static_cast<Eigen::Index>(k)], corner.depth / 16);
    }
  }
  return result;
}

PoseCover cover_poses(const BlockingPairs& pairs, const Orientations& orientations,
                      const std::vector<std::optional<ChartImage>>& images, const PositionBox& box, std::size_t& budget,
                      const Monitor& monitor) {
  PoseCover result;
  result.charts.reserve(orientations.charts().size());
  Covering covering(pairs, orientations, budget, monitor);
  for (std::uint32_t chart = 0; chart < orientations.charts().size(); ++chart) {
    if (images[chart]) {
      result.charts.push_back(image_of(result.charts[images[chart]->of], *images[chart]));
      continue;
    }
    CoverPart part{box, {}};
    part.orientation.chart = chart;
    if (covering.cover(part, pairs.turned(part.orientation), pairs.all(), result.charts.emplace_back())) continue;
    result.open = covering.open();
    break;
  }
  return result;
}

}  // namespace nef::planner
