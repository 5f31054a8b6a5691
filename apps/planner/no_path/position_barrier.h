// SPDX-License-Identifier: Apache-2.0
//
// A barrier of positions that one point of a robot cannot take, however the robot is turned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "apps/planner/no_path/barrier_graph.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/no_path/chart_images.h"
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
  /// boxes, which becomes what is left of it. In the latter case it may be called again, and goes on. Throws
  /// Interrupted when the monitor stops it.
  bool find(std::size_t& budget, const Monitor& monitor = {});

  /// The boxes of a barrier that was found; to be called once, last.
  [[nodiscard]] PathProof::PoseCells take_written() {
    return graph_.take_written(reference_, orientations_.charts().size());
  }

  /// The efforts of the boxes of the barrier that was looked at last, if all of it seems to be blocked: a measure of
  /// how deep pieces overlap there, rather than of how many boxes it takes.
  [[nodiscard]] std::optional<std::size_t> boxes_left() const;
  /// Boxes of positions in the way that are not known to be blocked.
  [[nodiscard]] std::vector<PositionBox> in_question() const;

 private:
  using CellId = BarrierGraph::Id;

  // What is known of the cell of the same number.
  struct Judged {
    bool is_blocked = false;  // its middle is blocked at all sample orientations
    bool is_settled = false;  // so are the middles of its facets
    double effort = 0;        // about how many parts it takes to cover it, if it is blocked
  };

  // The numbers of samples, those first at which a position was free last.
  using Order = std::vector<std::uint32_t>;
  // Those at which a position was free while a cell was judged.
  using FreeSamples = std::vector<std::uint32_t>;

  void add_samples();
  void judge(std::span<const CellId> ids, const Monitor& monitor);
  void judge(CellId id, Order& order, FreeSamples& free, const Monitor& monitor);
  void choose_axis(BarrierCell& cell, Judged& judged, Order& order, FreeSamples& free, const Monitor& monitor) const;
  void weigh(CellId id);
  static void move_forward(Order& order, std::size_t at) { std::swap(order[at], order[at / 2]); }
  [[nodiscard]] double depth(const BarrierCell& cell, const TurnedRobot& robot, const Vector3d& position,
                             const Monitor& monitor) const;
  double effort_at(const BarrierCell& cell, const Vector3d& position, Order& order, FreeSamples& free,
                   const Monitor& monitor) const;
  bool advance(std::size_t& budget, const Monitor& monitor);
  bool cover(std::vector<CellId> ids, std::size_t& budget, const Monitor& monitor);
  void add_open(CellId id, const OpenPose& open, std::size_t& budget, const Monitor& monitor);

  const Orientations& orientations_;
  Rational3 reference_;
  std::vector<std::optional<ChartImage>> images_;  // of each chart
  BlockingPairs pairs_;
  // An orientation; those that are special, as a robot with right angles would have them, do not count in efforts.
  struct Sample {
    TurnedRobot robot;
    double weight = 1;
  };
  std::vector<Sample> samples_;
  Order order_;
  BarrierGraph graph_;
  std::vector<Judged> judged_;
};

}  // namespace nef::planner
