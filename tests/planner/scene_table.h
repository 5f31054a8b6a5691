// SPDX-License-Identifier: Apache-2.0
//
// The scenes whose answers are known by hand and by an independent oracle, with every answer.
#pragma once

#include <string>
#include <vector>

#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {

/// What is known about a scene of data/planner. Lengths are in the scene's own unit.
struct Expected {
  std::string file;
  Answer::Status closed;  ///< with contact allowed
  int piece = 0;          ///< T and J of the best path, if solvable
  int junction = 0;
  std::vector<int> components;      ///< dimensions, largest first, with contact allowed
  Answer::Status open;              ///< with contact forbidden
  std::size_t open_components = 0;  ///< 0: not stated
  std::vector<Rational3> forced;    ///< way-points of the shortest path
  double length = 0;                ///< of the shortest path; 0: not stated
};

const std::vector<Expected>& scene_table();

/// Every column for a scene that is the table's under `map`: status, T, J, components and which of them are unbounded,
/// forced way-points, and the length unless `lengths` is false; and every segment by the independent check.
void check_closed(const Expected& expected, const Scene& scene, const AffineMap& map, bool lengths);
/// The columns for contact forbidden; the scene's own rule is overruled.
void check_open(const Expected& expected, Scene scene);

}  // namespace nef::planner::test
