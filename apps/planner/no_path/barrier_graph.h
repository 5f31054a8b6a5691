// SPDX-License-Identifier: Apache-2.0
//
// Boxes of positions among which a barrier between start and goal is looked for, and which of them lie next to each
// other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "apps/planner/no_path/barrier_bounds.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/no_path/minimum_cut.h"
#include "apps/planner/proofs/path_proof.h"

namespace nef::planner {

/// Positions of the reference point in a box.
struct BarrierCell {
  using Id = std::uint32_t;
  enum class State : std::uint8_t { kOpen, kCut, kBlocked };

  PositionBox box;
  State state = State::kOpen;
  bool is_hopeless = false;                          ///< not to be cut: all of it is free, or it is small
  std::int64_t weight = WeightedGraph::kUncuttable;  ///< about how many boxes it takes to block the way through it
  std::uint32_t axis = 0;                            ///< where to cut it: a coordinate
  std::array<Id, 2> halves{};
  std::vector<Id> neighbours;                ///< those that are not blocked; some of them may have been cut
  std::vector<BlockingPairs::Pair> pairs;    ///< that may overlap in it
  std::vector<PathProof::PoseCell> blocked;  ///< what shows that it is blocked, for each chart that it goes through

  /// Where it is cut.
  [[nodiscard]] double middle_of_axis() const;
};

/// A tree of boxes: they are judged and cut by those who look for a barrier. Cells are known by their numbers: kOutside
/// is what lies beyond the bounds, then come the root and the halves of cells that are cut.
class BarrierGraph {
 public:
  using Id = BarrierCell::Id;
  static constexpr Id kOutside = 0;

  /// Only outside is there. `reach`: no point of the robot is farther from the reference point.
  BarrierGraph(const PathProof::Claim& claim, const Rational3& reference, double reach);

  [[nodiscard]] const BarrierBounds& bounds() const { return bounds_; }
  [[nodiscard]] bool is_bounded() const { return is_bounded_; }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] BarrierCell& operator[](Id id) { return cells_[id]; }
  [[nodiscard]] const BarrierCell& operator[](Id id) const { return cells_[id]; }

  using Judge = std::function<void(Id)>;
  /// All positions within the bounds: a cell that `judge` gives its weight and axis. To be called once, first.
  void add_root(std::vector<BlockingPairs::Pair> pairs, const Judge& judge);
  /// Cuts a cell into two halves, which are judged.
  void cut(Id id, const Judge& judge);

  /// The open cells of the cheapest barrier, which are in question; or start and goal, if all barriers go through what
  /// is hopeless. None if nothing is left to be done: if a barrier was found, or cannot be.
  std::vector<Id> cheapest_barrier();
  /// Whether blocked cells separate start and goal, by the last call of cheapest_barrier.
  [[nodiscard]] bool is_found() const { return is_found_; }
  /// How many cells of that barrier are not known to be blocked.
  [[nodiscard]] std::size_t in_question() const { return in_question_; }

  /// The boxes of a barrier that was found, for each chart.
  [[nodiscard]] PathProof::PoseCells written(const Rational3& reference, std::size_t charts) const;

 private:
  [[nodiscard]] Id cell_of(const Vector3d& position) const;
  [[nodiscard]] bool touches_outside(const PositionBox& box) const;
  [[nodiscard]] static bool have_facet_in_common(const PositionBox& a, const PositionBox& b);
  void link(Id a, Id b);
  [[nodiscard]] std::vector<bool> reached() const;
  [[nodiscard]] PathProof::PoseCell written(Id id, std::size_t chart, const std::vector<bool>& at_start) const;

  bool is_bounded_;
  BarrierBounds bounds_;
  std::array<Vector3d, 2> ends_;  // of the reference point
  std::vector<BarrierCell> cells_;
  bool is_found_ = false;
  std::size_t in_question_ = 0;
};

}  // namespace nef::planner
