// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a robot which turns has no path, as data that anybody can check.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turning_question.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Why there is no path, whatever the robot does within the range. At every angle of a cell [a, b] the robot holds the
/// cell's inner robot, so within the cell it stays in one component of the inner robot's free positions; at the angle
/// of a breakpoint it is in one component of its own. Components of cells and of breakpoints next to each other are
/// joined where they have a position in common. What is joined to the start does not hold the goal.
struct TurningProof {
  struct Cell {
    std::vector<std::vector<Rational3>> inner;  ///< convex pieces, turned as in the scene, by their vertices
    std::vector<Rational3> start_side;          ///< a position in each component that is joined to the start
  };
  std::vector<Turn> breakpoints;  ///< ascending, the ends of the range first and last, start and goal among them
  std::vector<Cell> cells;        ///< between them
};

/// What is wrong with a proof; nothing if it holds. Shares with what finds proofs no more than hulls, Boolean
/// operations and the cutting of sets into convex pieces, whose pieces it checks: each vertex of an inner robot is
/// followed along its arc through a piece of the robot; free positions are what remains of space without the
/// differences of convex pieces; components are split off as sets, and joined where their intersection is not empty.
/// Costs several times as much as the search.
std::optional<std::string> complaint_about(const TurningProof& proof, const Scene& scene,
                                           const TurningQuestion& question, const Monitor& monitor = {});

}  // namespace nef::planner
