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

/// A question about a robot that may turn about an axis through its reference point.
struct TurningQuestion {
  TurningAxis axis{{0, 0, 1}};
  Turn low = 0;  ///< the range of angles; one that is 4 wide is the full circle, closed to a ring
  Turn high = 4;
  Pose start;
  Pose goal;
};

struct TurningLimits {
  std::size_t max_cells = 2000;  ///< cells of angles that the range is cut into
  std::function<bool()> stop;    ///< asked now and then; true ends the search
};

/// A closed range of angles.
struct TurnRange {
  Turn low;
  Turn high;
};

struct TurningAnswer {
  enum class Status : std::uint8_t { kPath, kInfeasible, kUndecided, kInvalidStart, kInvalidGoal };
  Status status = Status::kUndecided;
  /// kPath: way-points; between two either the turn or the position stays. Angles go on where the full circle closes,
  /// so they may leave the range by full turns.
  std::vector<Pose> path;
  /// kInfeasible: the breakpoints of the proof. kUndecided: the ranges in question.
  std::vector<Turn> breakpoints;
  std::vector<TurnRange> open_ranges;
  std::size_t cells = 0;      ///< that the range is cut into in the end
  std::size_t looked_at = 0;  ///< those that were split again, too
};

/// The question of a scene with a rotation, a start and a goal. Angles become rational turns; those of start and goal
/// are taken into the range by full turns, if they can be.
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
