// SPDX-License-Identifier: Apache-2.0
//
// Paths of a robot that translates and turns about one axis, and proofs that there are none.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turn.h"

namespace nef::planner {

/// Where the reference point is, and how the robot is turned.
struct Pose {
  Rational3 position;
  Turn turn;
};

/// A question about a robot that may turn about a coordinate axis through its reference point.
struct TurningQuestion {
  std::size_t axis = 2;  ///< 0 to 2
  Turn low = 0;          ///< the range of angles; from 0 to 4 is the full circle, closed to a ring
  Turn high = 4;
  Pose start;
  Pose goal;
};

struct TurningLimits {
  std::size_t max_cells = 2000;  ///< cells of angles, split ones included
  std::function<bool()> stop;    ///< asked between cells; true ends the search
};

/// A closed range of angles.
struct TurnRange {
  Turn low;
  Turn high;
};

struct TurningAnswer {
  enum class Status : std::uint8_t { kPath, kInfeasible, kUndecided, kInvalidStart, kInvalidGoal };
  Status status = Status::kUndecided;
  /// kPath: way-points; between two either the turn or the position stays.
  std::vector<Pose> path;
  /// kInfeasible: the breakpoints of the proof. kUndecided: the ranges in question.
  std::vector<Turn> breakpoints;
  std::vector<TurnRange> open_ranges;
  std::size_t cells = 0;  ///< looked at
};

/// The question of a scene with a rotation, a start and a goal. Angles become rational turns.
TurningQuestion question_of(const Scene& scene);

/// Decides by cells of angles (docs/planner.md, "Turning"). For each cell [a, b] the free space of an outer robot,
/// which holds the robot at every angle of the cell: there the robot may turn from a to b on the spot. Components of
/// those and of the exact free spaces at the ends of cells make a graph in which a way is a path. And the free space of
/// an inner robot, which every angle of the cell holds: whoever moves within the cell stays in one component of it. If
/// start and goal are apart in the graph of those, there is no path. Otherwise the cells that a way through the latter
/// needs and the former does not grant are split, at an angle where a face of the robot is parallel to one of an
/// obstacle if there is one inside. Every motion of a path is checked once more before it is returned. Contact that
/// must be kept while turning stays undecided for ever. The robot must be a bounded solid, else InputError.
TurningAnswer find_turning_path(const Scene& scene, const TurningQuestion& question, const TurningLimits& limits = {});

}  // namespace nef::planner
