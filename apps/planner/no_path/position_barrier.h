// SPDX-License-Identifier: Apache-2.0
//
// A barrier of positions that one point of a robot cannot take, however the robot is turned.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/planner/no_path/barrier_graph.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/no_path/chart_images.h"
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
  [[nodiscard]] PathProof::PoseCells written() const {
    return graph_.written(reference_, orientations_.charts().size());
  }

  /// Boxes of positions in the way that are not known to be blocked.
  [[nodiscard]] std::size_t in_question() const { return graph_.in_question(); }

 private:
  using CellId = BarrierGraph::Id;

  // What is known of the cell of the same number.
  struct Judged {
    bool is_blocked = false;  // its middle is blocked at all sample orientations
    bool is_settled = false;  // so are the middles of its facets
    double effort = 0;        // about how many parts it takes to cover it, if it is blocked
  };

  void add_samples();
  void judge(CellId id);
  void choose_axis(BarrierCell& cell, Judged& judged);
  void weigh(CellId id);
  [[nodiscard]] double depth(const BarrierCell& cell, const TurnedRobot& robot, const Vector3d& position) const;
  double effort_at(const BarrierCell& cell, const Vector3d& position);
  bool advance(std::size_t& budget);
  bool cover(CellId id, std::size_t& budget);

  const Orientations& orientations_;
  Rational3 reference_;
  std::vector<std::optional<ChartImage>> images_;  // of each chart
  BlockingPairs pairs_;
  Monitor monitor_;
  // An orientation; those that are special, as a robot with right angles would have them, do not count in efforts.
  struct Sample {
    TurnedRobot robot;
    double weight = 1;
  };
  std::vector<Sample> samples_;  // those first at which a position was free last
  BarrierGraph graph_;
  std::vector<Judged> judged_;
};

}  // namespace nef::planner
