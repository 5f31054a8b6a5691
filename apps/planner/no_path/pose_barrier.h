// SPDX-License-Identifier: Apache-2.0
//
// A barrier of poses that a robot which turns along a chain of arcs cannot take.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/planner/no_path/barrier_bounds.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/proofs/path_proof.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Looks for boxes of poses (positions of the reference point, and a range of angles), each of them blocked, that
/// separate start and goal. Positions that are free at some angles and not at others may be on both sides, so this
/// finds barriers where PositionBarrier cannot; it is for orientations with one parameter.
class PoseBarrier {
 public:
  /// The claim has both poses, and a chain of rotations; `reference` is the point of the robot whose positions are
  /// meant.
  PoseBarrier(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference,
              const Monitor& monitor = {});

  /// True if a barrier was found; false if there is none, as far as doubles can tell, or if it needs more than `budget`
  /// boxes, which becomes what is left of it.
  bool find(std::size_t& budget);

  /// The boxes of a barrier that was found.
  [[nodiscard]] PathProof::PoseCells written() const;

  /// Boxes in the way that are not known to be blocked.
  [[nodiscard]] std::size_t in_question() const { return in_question_; }

 private:
  using CellId = std::uint32_t;
  enum class State : std::uint8_t { kOpen, kCut, kBlocked };
  static constexpr CellId kOutside = 0;
  static constexpr std::uint32_t kAngle = 3;   // the axis after the coordinates
  static constexpr double kFree = 1e7;         // about the weight of a box that is free in the middle
  static constexpr double kSmallest = 0x1p-9;  // parts of the robot's reach; smaller boxes are not cut

  struct Cell {
    PositionBox box;
    OrientationBox<double> orientation;
    State state = State::kOpen;
    bool is_hopeless = false;  // not to be cut: all of it is free, or it is small
    std::int64_t weight = 0;   // about how many boxes it takes to block the way through it
    std::uint32_t axis = 0;    // where to cut it
    std::array<CellId, 2> halves{};
    std::vector<CellId> neighbours;          // some of them may have been cut
    std::vector<BlockingPairs::Pair> pairs;  // that may overlap in it
    PathProof::PoseCell blocked;             // if it is blocked
  };
  struct End {
    Vector3d position;
    std::uint32_t chart = 0;
    double parameter = 0;
  };

  [[nodiscard]] End end_of(const RigidPose& pose) const;
  [[nodiscard]] double half_angle(const OrientationBox<double>& orientation) const;
  void judge(Cell& cell);
  [[nodiscard]] double depth(const Cell& cell, const TurnedRobot& robot, const Vector3d& position) const;
  void weigh(Cell& cell, const TurnedRobot& middle, double deepest, double angle);
  [[nodiscard]] CellId cell_of(const End& end) const;
  bool advance(std::size_t& budget);
  void cut(CellId id);
  void link(CellId a, CellId b);
  [[nodiscard]] std::vector<bool> reached() const;
  [[nodiscard]] PathProof::PoseCell written(CellId id, const std::vector<bool>& at_start) const;

  const Orientations& orientations_;
  Rational3 reference_;
  BlockingPairs pairs_;
  Monitor monitor_;
  bool is_bounded_;
  BarrierBounds bounds_;
  double reference_reach_ = 0;  // how far the reference point is from the origin
  std::array<End, 2> ends_;     // start and goal
  std::vector<Cell> cells_;     // 0 is what is beyond the bounds, then one for each chart
  bool is_closed_ = false;      // the last chart is followed by the first one
  bool is_found_ = false;
  std::size_t in_question_ = 0;
};

}  // namespace nef::planner
