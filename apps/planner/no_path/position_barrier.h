// SPDX-License-Identifier: Apache-2.0
//
// A barrier of positions that one point of a robot cannot take, however the robot is turned.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/planner/no_path/barrier_bounds.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/no_path/pose_cover.h"
#include "apps/planner/proofs/path_proof.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Looks for boxes of positions of the reference point, all of whose poses are blocked, that separate start and goal.
class PositionBarrier {
 public:
  /// The claim has both poses; `reference` is the point of the robot whose positions are meant.
  PositionBarrier(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference,
                  const Monitor& monitor = {});

  /// True if a barrier was found; false if there is none, as far as doubles can tell, or if it needs more than `budget`
  /// boxes, which becomes what is left of it.
  bool find(std::size_t& budget);

  /// The boxes of a barrier that was found.
  [[nodiscard]] PathProof::PoseCells written() const;

  /// Boxes of positions in the way that are not known to be blocked.
  [[nodiscard]] std::size_t in_question() const { return in_question_; }

 private:
  using CellId = std::uint32_t;
  enum class State : std::uint8_t { kOpen, kCut, kCovered };

  struct Cell {
    PositionBox box;
    State state = State::kOpen;
    bool is_hopeless = false;  // not to be cut: no pair is near, or the cell is small
    bool is_blocked = false;   // its middle is blocked at all sample orientations
    bool is_settled = false;   // so are the middles of its facets
    double effort = 0;         // about how many parts it takes to cover it, if it is blocked
    Eigen::Index axis = 0;     // where to cut it
    std::array<CellId, 2> halves{};
    std::vector<CellId> neighbours;          // some of them may have been cut
    std::vector<PathProof::PoseCell> cover;  // for each chart, if it is covered
    std::vector<BlockingPairs::Pair> pairs;  // that may meet in it
  };

  void add_samples();
  void judge(Cell& cell);
  void choose_axis(Cell& cell);
  [[nodiscard]] double depth(const Cell& cell, const TurnedRobot& robot, const Vector3d& position) const;
  double effort_at(const Cell& cell, const Vector3d& position);
  [[nodiscard]] CellId cell_of(const Vector3d& position) const;
  bool advance(std::size_t& budget);
  bool cover(CellId id, std::size_t& budget);
  void cut(CellId id);
  void link(CellId a, CellId b);
  [[nodiscard]] std::vector<bool> reached() const;
  [[nodiscard]] PathProof::PoseCell written(CellId id, std::size_t chart, const std::vector<bool>& at_start) const;

  const Orientations& orientations_;
  Rational3 reference_;
  BlockingPairs pairs_;
  Monitor monitor_;
  bool is_bounded_;
  BarrierBounds bounds_;
  std::array<Vector3d, 2> ends_;  // start and goal of the reference point
  // An orientation; those that are special, as a robot with right angles would have them, do not count in efforts.
  struct Sample {
    TurnedRobot robot;
    double weight = 1;
  };
  std::vector<Sample> samples_;  // those first at which a position was free last
  std::vector<Cell> cells_;      // 0 is what is beyond the bounds, 1 all within
  bool is_found_ = false;
  std::size_t in_question_ = 0;
};

}  // namespace nef::planner
