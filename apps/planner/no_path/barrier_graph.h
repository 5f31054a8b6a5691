// SPDX-License-Identifier: Apache-2.0
//
// Boxes of positions among which a barrier between start and goal is looked for, and which of them lie next to each
// other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/planner/no_path/barrier_bounds.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/no_path/minimum_cut.h"
#include "apps/planner/proofs/path_proof.h"
#include "nef/base/monitor.h"

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
  std::vector<Id> neighbours;              ///< those that are not blocked; some of them may have been cut
  std::vector<BlockingPairs::Pair> pairs;  ///< that may overlap in it
  /// What shows that it is blocked, for each chart that it goes through; of an open cell as far as that is known.
  std::vector<PathProof::PoseCell> blocked;

  /// Where it is cut.
  [[nodiscard]] double middle_of_axis() const;
};

/// A tree of boxes: they are judged (given a weight and an axis) and cut by those who look for a barrier. Cells are
/// known by their numbers: kOutside is what lies beyond the bounds, then come the root and the halves of cells that are
/// cut.
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

  /// All positions within the bounds; nobody has judged the cell. To be called once, first.
  Id add_root(std::vector<BlockingPairs::Pair> pairs);
  /// Cuts a cell into two halves, which are not judged.
  std::array<Id, 2> cut(Id id);

  /// The open cells of the cheapest barrier, which are in question; or start and goal, if all barriers go through what
  /// is hopeless. None if nothing is left to be done: if a barrier was found, or cannot be.
  std::vector<Id> cheapest_barrier(const Monitor& monitor);
  /// Whether blocked cells separate start and goal, by the last call of cheapest_barrier.
  [[nodiscard]] bool is_found() const { return is_found_; }
  /// The cells of that barrier that are not known to be blocked.
  [[nodiscard]] const std::vector<Id>& in_question() const { return in_question_; }

  /// The boxes of a barrier that was found, for each chart. They are taken out of the graph, which is of no use then.
  [[nodiscard]] PathProof::PoseCells take_written(const Rational3& reference, std::size_t charts);

 private:
  [[nodiscard]] Id cell_of(const Vector3d& position) const;
  [[nodiscard]] bool touches_outside(const PositionBox& box) const;
  [[nodiscard]] static bool have_facet_in_common(const PositionBox& a, const PositionBox& b);
  void link(Id a, Id b);
  [[nodiscard]] std::vector<bool> reached() const;
  PathProof::PoseCell take_written(Id id, std::size_t chart, const std::vector<bool>& at_start);

  bool is_bounded_;
  BarrierBounds bounds_;
  std::array<Vector3d, 2> ends_;  // of the reference point
  std::vector<BarrierCell> cells_;
  bool is_found_ = false;
  std::vector<Id> in_question_;
};

}  // namespace nef::planner
