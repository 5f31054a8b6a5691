// SPDX-License-Identifier: Apache-2.0
//
// A barrier of poses that a robot which turns along a chain of arcs cannot take.
#pragma once

#include <cstddef>

#include "apps/planner/no_path/barrier_graph.h"
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
  [[nodiscard]] PathProof::PoseCells written() const {
    return graph_.written(reference_, orientations_.charts().size());
  }

  /// Boxes in the way that are not known to be blocked.
  [[nodiscard]] std::size_t in_question() const { return graph_.in_question(); }

 private:
  using CellId = BarrierGraph::Id;
  static constexpr double kFree = 1e7;         // about the weight of a box that is free in the middle
  static constexpr double kSmallest = 0x1p-9;  // parts of the robot's reach; smaller boxes are not cut

  [[nodiscard]] BarrierGraph::End end_of(const RigidPose& pose) const;
  [[nodiscard]] double half_angle(const OrientationBox<double>& orientation) const;
  void judge(BarrierCell& cell);
  [[nodiscard]] double depth(const BarrierCell& cell, const TurnedRobot& robot, const Vector3d& position) const;
  void weigh(BarrierCell& cell, const TurnedRobot& middle, double deepest, double angle);
  bool advance(std::size_t& budget);

  const Orientations& orientations_;
  Rational3 reference_;
  BlockingPairs pairs_;
  Monitor monitor_;
  double reference_reach_;  // how far the reference point is from the origin
  BarrierGraph graph_;      // a root for each chart
};

}  // namespace nef::planner
