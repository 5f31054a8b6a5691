// SPDX-License-Identifier: Apache-2.0
//
// Paths of a robot that translates and turns about one axis, and proofs that there are none.
#pragma once

#include <optional>
#include <vector>

#include "apps/planner/path/answer.h"
#include "apps/planner/turning/turning_proof.h"
#include "apps/planner/turning/turning_question.h"
#include "nef/base/monitor.h"

namespace nef::planner {

struct TurningLimits {
  std::size_t max_cells = 2000;  ///< cells of angles that the range is cut into
  /// Round way-points to so many decimals where the motions stay free. (Turns have the digits that their cells have.)
  std::optional<unsigned> digits = {};
};

/// A closed range of angles.
struct TurnRange {
  Turn low;
  Turn high;
};

struct TurningAnswer {
  using Status = AnswerStatus;  ///< kPath, kInfeasible, kUndecided, kInvalidStart or kInvalidGoal
  Status status = Status::kUndecided;
  /// kPath: way-points; between two either the turn or the position stays. Angles go on where the full circle closes,
  /// so they may leave the range by full turns.
  std::vector<Pose> path;
  std::vector<std::size_t> unrounded;  ///< way-points between the ends with more decimals than were asked for
  std::optional<TurningProof> proof;   ///< kInfeasible
  std::optional<Collision> collision;  ///< kInvalidStart, kInvalidGoal
  std::vector<TurnRange> open_ranges;  ///< kUndecided: those in question
  std::size_t cells = 0;               ///< that the range is cut into in the end
  std::size_t looked_at = 0;           ///< those that were split again, too
};

/// The answer that start or goal is not free, which needs no search; nothing if both are. The robot must be a bounded
/// solid, else InputError.
std::optional<TurningAnswer> invalid_turning_end(const Scene& scene, const TurningQuestion& question,
                                                 const Monitor& monitor = {});

/// Decides by cells of angles (docs/planner.md, "Turning"). For each cell [a, b] the free space of an outer robot,
/// which holds the robot at every angle of the cell: there the robot may turn from a to b on the spot. Components of
/// those and of the exact free spaces at the ends of cells make a graph in which a way is a path. And the free space of
/// an inner robot, which every angle of the cell holds: whoever moves within the cell stays in one component of it. If
/// start and goal are apart in the graph of those, there is no path. Otherwise the cells that a way through the latter
/// needs and the former does not grant are split, at an angle where a face of the robot is parallel to one of an
/// obstacle if there is one inside. Every motion of a path is checked once more before it is returned. Contact that
/// must be kept while turning stays undecided for ever, and what is not decided when the monitor stops the search. The
/// robot must be a bounded solid, else InputError.
TurningAnswer find_turning_path(const Scene& scene, const TurningQuestion& question, const TurningLimits& limits = {},
                                const Monitor& monitor = {});

}  // namespace nef::planner
