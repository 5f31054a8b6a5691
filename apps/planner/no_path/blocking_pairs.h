// SPDX-License-Identifier: Apache-2.0
//
// Where a piece of a turned robot overlaps an obstacle's, at a pose or at every pose of a box: in doubles, for a search
// whose result is checked exactly.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/no_path/small_program.h"
#include "apps/planner/orientation/orientation_cells.h"
#include "apps/planner/proofs/path_proof.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// A solid convex piece: where all normals * x <= offset. Normals have length 1.
struct RoughSolid {
  std::vector<Vector3d> normals;
  std::vector<double> offsets;
  Vector3d low{0, 0, 0}, high{0, 0, 0};  ///< the box around it
  double reach = 0;                      ///< no point is farther from the origin
};

/// The half-spaces of an inner piece (orientation_cells.h); none if the box of orientations is too large for one.
struct InnerPiece {
  std::vector<Vector3d> normals;
  std::vector<double> lengths;  ///< of the normals
  std::vector<double> offsets;
};

/// The robot's inner pieces for all orientations of a box.
struct TurnedRobot {
  std::vector<InnerPiece> pieces;
  std::vector<Vector3d> origins;               ///< mixed rotations of the robot's origin, seen from the reference point
  std::vector<ScaledMatrix<double>> matrices;  ///< the mixed rotations of the box; none if it is too large
};

/// A box of positions of the reference point.
struct PositionBox {
  Vector3d low, high;
  [[nodiscard]] Vector3d middle() const { return (low + high) / 2; }
  [[nodiscard]] bool has(const Vector3d& p) const {
    return (low.array() <= p.array()).all() && (p.array() <= high.array()).all();
  }
  [[nodiscard]] std::array<Vector3d, 8> corners() const {
    std::array<Vector3d, 8> result;
    for (std::size_t i = 0; i < 8; ++i) {
      result[i] = {(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]};
    }
    return result;
  }
};

/// A point of an obstacle inside of the robot, and how deep; 0 if there is none.
struct CommonDepth {
  Vector3d point{0, 0, 0};
  double depth = 0;
};

/// Points of an obstacle inside of the robot that drift as it turns (DriftingPiece).
struct DriftingDepths {
  double middle = 0;              ///< how deep the point is at the middle of the positions; 0 if it is not
  std::array<Vector3d, 3> drift;  ///< for each parameter of the box of orientations, up to its upper end
  std::vector<CommonDepth> at;    ///< in the middle of that box, at the positions
};

/// A robot among obstacles, as what may block its poses. The orientations must outlive it.
class BlockingPairs {
 public:
  /// A piece of the robot and one of the obstacles.
  using Pair = std::array<std::uint32_t, 2>;

  /// Pieces of the claim that are flat block nothing. `reference`: the point of the robot whose positions are meant.
  BlockingPairs(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference,
                const Monitor& monitor);

  /// All pairs of solid pieces.
  [[nodiscard]] std::vector<Pair> all() const;

  /// The robot at all orientations of a box, or at one (`low` and `high` are equal).
  [[nodiscard]] TurnedRobot turned(const OrientationBox<double>& box) const;

  /// Whether a pair may touch at a position of the box, however the robot is turned.
  [[nodiscard]] bool may_meet(const Pair& pair, const PositionBox& box) const;

  /// How a pair overlaps at a position.
  [[nodiscard]] CommonDepth at(const Pair& pair, const TurnedRobot& robot, const Vector3d& position) const;
  /// The same at some positions, in their order, up to the first one at which it does not: if it does at all of them,
  /// it does at all positions of their hull.
  [[nodiscard]] std::vector<CommonDepth> at_all(const Pair& pair, const TurnedRobot& robot,
                                                std::span<const Vector3d> positions) const;

  /// How a pair overlaps at some positions at all orientations for which the robot is turned, if the points in common
  /// drift; the drift is one that suits the middle of the positions. Up to the first position at which the pair does
  /// not overlap. Nothing if the orientations have not three parameters, or are too many.
  [[nodiscard]] DriftingDepths drifting_at_all(const Pair& pair, const TurnedRobot& robot, const Vector3d& middle,
                                               std::span<const Vector3d> positions) const;

  /// How far all positions of the box are beyond a side of the claim's box, and which side (0 to 2 the lower ones, 3 to
  /// 5 the upper ones); below zero if some are not beyond any.
  [[nodiscard]] std::pair<double, std::uint32_t> beyond(const TurnedRobot& robot, const PositionBox& box) const;

  /// Lengths below this count as zero.
  [[nodiscard]] double resolution() const { return scale_ * 1e-9; }
  /// No point of the robot is farther from the reference point.
  [[nodiscard]] double reach() const { return reach_; }

 private:
  const Orientations& orientations_;
  Vector3d reference_;
  std::vector<RoughSolid> robot_;
  std::vector<RoughSolid> obstacles_;
  std::optional<PositionBox> box_;
  double reach_ = 0;
  double scale_ = 1;
};

}  // namespace nef::planner
