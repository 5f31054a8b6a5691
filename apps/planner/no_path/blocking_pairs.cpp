// SPDX-License-Identifier: Apache-2.0
//
// A pair overlaps at a position x if a point y is in the obstacle's half-spaces o y <= d, and y - x in those of the
// inner piece, m (y - x) <= c. How deep it does is the largest s with m (y - x) + |m| s <= c and o y + s / 10 <= d, so
// that y may be rounded to short numbers.
#include "apps/planner/no_path/blocking_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/planner/intersection/hulls_apart.h"
#include "apps/planner/no_path/drifting_piece.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

constexpr double kInObstacle = 0.1;  // the part of the depth by which a common point is inside the obstacle

RoughSolid rough_solid(const std::vector<Rational3>& vertices) {
  RoughSolid result;
  const Hull hull = hull_of(vertices);
  if (hull.dimension < 3) return result;
  for (const HalfSpace& face : half_spaces_of(hull.mesh)) {
    const Vector3d normal = to_vector(face.normal);
    result.normals.push_back(normal / normal.norm());
    result.offsets.push_back(nearest_double(face.offset) / normal.norm());
  }
  result.low = result.high = to_vector(vertices.front());
  for (const Rational3& v : vertices) {
    const Vector3d point = to_vector(v);
    result.low = result.low.cwiseMin(point);
    result.high = result.high.cwiseMax(point);
    result.reach = std::max(result.reach, point.norm());
  }
  return result;
}

using Matrices = std::vector<ScaledMatrix<double>>;

Vector3d turned_vector(const ScaledMatrix<double>& m, const Vector3d& v) {
  Vector3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[static_cast<Eigen::Index>(i)] = (m.rows[i][0] * v[0] + m.rows[i][1] * v[1] + m.rows[i][2] * v[2]) / m.scale;
  }
  return result;
}

InnerPiece inner_piece(const RoughSolid& piece, const Matrices& matrices) {
  InnerPiece result;
  const std::size_t planes = piece.normals.size() * matrices.size();
  result.normals.reserve(planes);
  result.lengths.reserve(planes);
  result.offsets.reserve(planes);
  for (std::size_t f = 0; f < piece.normals.size(); ++f) {
    for (const ScaledMatrix<double>& m : matrices) {
      result.normals.push_back(turned_vector(m, piece.normals[f]));
      result.lengths.push_back(result.normals.back().norm());
      result.offsets.push_back(piece.offsets[f]);
    }
  }
  return result;
}

}  // namespace

BlockingPairs::BlockingPairs(const PathProof::Claim& claim, const Orientations& orientations,
                             const Rational3& reference, const Monitor& monitor)
    : orientations_(orientations), reference_(to_vector(reference)) {
  for (const std::vector<Rational3>& piece : claim.robot) {
    monitor.check_interruption();
    std::vector<Rational3> shifted;
    for (const Rational3& v : piece) shifted.push_back(minus(v, reference));
    robot_.push_back(rough_solid(shifted));
    reach_ = std::max(reach_, robot_.back().reach);
  }
  if (claim.box) box_ = {to_vector((*claim.box)[0]), to_vector((*claim.box)[1])};
  scale_ = reach_;
  for (const std::vector<Rational3>& piece : claim.obstacles) {
    monitor.check_interruption();
    obstacles_.push_back(rough_solid(piece));
    scale_ = std::max(scale_, obstacles_.back().reach);
  }
}

std::vector<BlockingPairs::Pair> BlockingPairs::all() const {
  std::vector<Pair> result;
  for (std::uint32_t i = 0; i < robot_.size(); ++i) {
    for (std::uint32_t j = 0; j < obstacles_.size(); ++j) {
      if (!robot_[i].normals.empty() && !obstacles_[j].normals.empty()) result.push_back({i, j});
    }
  }
  return result;
}

TurnedRobot BlockingPairs::turned(const OrientationBox<double>& box) const {
  const Orientations::Chart& exact = orientations_.charts()[box.chart];
  const auto rounded = [](const Quaternion& q) {
    return std::array{nearest_double(q[0]), nearest_double(q[1]), nearest_double(q[2]), nearest_double(q[3])};
  };
  std::vector<std::array<double, 4>> directions;
  for (const Quaternion& direction : exact.directions) directions.push_back(rounded(direction));
  Matrices mixed = mixed_rotations(rounded(exact.origin), directions, box.low, box.high);
  if (box.low == box.high && !mixed.empty()) mixed.resize(1);
  TurnedRobot result;
  for (const RoughSolid& piece : robot_) result.pieces.push_back(inner_piece(piece, mixed));
  for (const ScaledMatrix<double>& m : mixed) result.origins.push_back(turned_vector(m, -reference_));
  result.matrices = std::move(mixed);
  return result;
}

bool BlockingPairs::may_meet(const Pair& pair, const PositionBox& box) const {
  const RoughSolid& obstacle = obstacles_[pair[1]];
  double square = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double gap = std::max({obstacle.low[k] - box.high[k], box.low[k] - obstacle.high[k], 0.0});
    square += gap * gap;
  }
  const double reach = robot_[pair[0]].reach;
  return square < reach * reach;
}

namespace {

// The largest s for points y as above; the first rows are the inner piece's, whose bounds depend on the position.
class DepthProgram {
 public:
  DepthProgram(const InnerPiece& piece, const RoughSolid& obstacle) : piece_(piece) {
    program_.reserve(piece.normals.size() + obstacle.normals.size());
    for (std::size_t r = 0; r < piece.normals.size(); ++r) {
      const Vector3d& m = piece.normals[r];
      program_.add({m[0], m[1], m[2], piece.lengths[r]}, 0);
    }
    for (std::size_t r = 0; r < obstacle.normals.size(); ++r) {
      const Vector3d& o = obstacle.normals[r];
      program_.add({o[0], o[1], o[2], kInObstacle}, obstacle.offsets[r]);
    }
  }

  CommonDepth at(const Vector3d& position, double limit, double least) {
    if (piece_.normals.empty()) return {};
    for (std::size_t r = 0; r < piece_.normals.size(); ++r) {
      program_.set_bound(r, piece_.offsets[r] + piece_.normals[r].dot(position));
    }
    const auto found = program_.maximize({0, 0, 0, 1}, limit, least);
    if (!found) return {};
    return {{(*found)[0], (*found)[1], (*found)[2]}, found->back()};
  }

 private:
  const InnerPiece& piece_;
  SmallProgram<4> program_;
};

}  // namespace

CommonDepth BlockingPairs::at(const Pair& pair, const TurnedRobot& robot, const Vector3d& position) const {
  return DepthProgram(robot.pieces[pair[0]], obstacles_[pair[1]]).at(position, 8 * scale_, resolution());
}

std::vector<CommonDepth> BlockingPairs::at_all(const Pair& pair, const TurnedRobot& robot,
                                               std::span<const Vector3d> positions) const {
  DepthProgram program(robot.pieces[pair[0]], obstacles_[pair[1]]);
  std::vector<CommonDepth> result;
  for (const Vector3d& position : positions) {
    const CommonDepth depth = program.at(position, 8 * scale_, resolution());
    if (depth.depth <= resolution()) break;
    result.push_back(depth);
  }
  return result;
}

namespace {

using Drift = std::array<Vector3d, 3>;

// The drift with which a point is deepest inside both at the corners of the box of orientations, at one position. What
// lies between the corners is left to the user of the drift.
std::optional<Drift> best_drift(const DriftingPiece& piece, const RoughSolid& obstacle, const Vector3d& position,
                                double limit, double least) {
  constexpr std::size_t kDepth = 12;  // the variables: a point, its drifts, and how deep it is
  SmallProgram<kDepth + 1> program;
  const auto add = [&](const Vector3d& normal, const Drift& drifts, double length, double bound) {
    std::array<double, kDepth + 1> row{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      row[i] = normal[at];
      for (std::size_t k = 0; k < 3; ++k) row[3 + 3 * k + i] = drifts[k][at];
    }
    row[kDepth] = length;
    program.add(row, bound);
  };
  constexpr std::size_t kCorners = 8;
  program.reserve(piece.half_spaces.size() / kCorners + kCorners * obstacle.normals.size());
  for (const DriftingPiece::HalfSpace& h : piece.half_spaces) {
    if (h.is_corner) add(h.normal, h.drifts, h.length, h.offset);
  }
  for (std::size_t r = 0; r < obstacle.normals.size(); ++r) {
    const Vector3d& o = obstacle.normals[r];
    for (std::size_t corner = 0; corner < kCorners; ++corner) {
      Drift drifts;
      for (std::size_t k = 0; k < 3; ++k) drifts[k] = ((corner >> k) & 1) != 0 ? o : Vector3d(-o);
      add(o, drifts, kInObstacle, obstacle.offsets[r] - o.dot(position));
    }
  }
  std::array<double, kDepth + 1> objective{};
  objective[kDepth] = 1;
  const auto found = program.maximize(objective, limit, least);
  if (!found) return std::nullopt;
  Drift result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = {(*found)[3 + 3 * k], (*found)[4 + 3 * k], (*found)[5 + 3 * k]};
  return result;
}

// The deepest points with a given drift.
class DriftProgram {
 public:
  DriftProgram(const DriftingPiece& piece, const RoughSolid& obstacle, const Drift& drift)
      : obstacle_(obstacle), first_(piece.half_spaces.size()) {
    program_.reserve(first_ + obstacle.normals.size());
    for (const DriftingPiece::HalfSpace& h : piece.half_spaces) {
      double bound = h.offset;
      for (std::size_t k = 0; k < 3; ++k) bound -= h.drifts[k].dot(drift[k]);
      program_.add({h.normal[0], h.normal[1], h.normal[2], h.length}, bound);
    }
    for (std::size_t r = 0; r < obstacle.normals.size(); ++r) {
      const Vector3d& o = obstacle.normals[r];
      program_.add({o[0], o[1], o[2], kInObstacle}, 0);
      double bound = obstacle.offsets[r];
      for (const Vector3d& way : drift) bound -= std::fabs(o.dot(way));
      bounds_.push_back(bound);
    }
  }

  CommonDepth at(const Vector3d& position, double limit, double least) {
    for (std::size_t r = 0; r < bounds_.size(); ++r) {
      program_.set_bound(first_ + r, bounds_[r] - obstacle_.normals[r].dot(position));
    }
    const auto found = program_.maximize({0, 0, 0, 1}, limit, least);
    if (!found) return {};
    return {position + Vector3d((*found)[0], (*found)[1], (*found)[2]), found->back()};
  }

 private:
  const RoughSolid& obstacle_;
  std::size_t first_;  // the row of the obstacle's first face
  std::vector<double> bounds_;
  SmallProgram<4> program_;
};

}  // namespace

DriftingDepths BlockingPairs::drifting_at_all(const Pair& pair, const TurnedRobot& robot, const Vector3d& middle,
                                              std::span<const Vector3d> positions) const {
  const RoughSolid& moving = robot_[pair[0]];
  const RoughSolid& obstacle = obstacles_[pair[1]];
  const DriftingPiece piece = drifting_piece(moving.normals, moving.offsets, robot.matrices);
  DriftingDepths result;
  if (piece.half_spaces.empty()) return result;
  const std::optional<Drift> drift = best_drift(piece, obstacle, middle, 8 * scale_, resolution());
  if (!drift) return result;
  result.drift = *drift;
  DriftProgram program(piece, obstacle, *drift);
  result.middle = program.at(middle, 8 * scale_, resolution()).depth;
  if (result.middle <= resolution()) return result;
  for (const Vector3d& position : positions) {
    const CommonDepth depth = program.at(position, 8 * scale_, resolution());
    if (depth.depth <= resolution()) break;
    result.at.push_back(depth);
  }
  return result;
}

std::pair<double, std::uint32_t> BlockingPairs::beyond(const TurnedRobot& robot, const PositionBox& box) const {
  std::pair<double, std::uint32_t> best{-HUGE_VAL, 0};
  if (!box_ || robot.origins.empty()) return best;
  for (std::uint32_t side = 0; side < 6; ++side) {
    const Eigen::Index k = side % 3;
    double least = HUGE_VAL;
    for (const Vector3d& origin : robot.origins) {
      least =
          std::min(least, side < 3 ? box_->low[k] - origin[k] - box.high[k] : box.low[k] + origin[k] - box_->high[k]);
    }
    best = std::max(best, {least - resolution(), side});
  }
  return best;
}

}  // namespace nef::planner
