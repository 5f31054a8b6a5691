// SPDX-License-Identifier: Apache-2.0
//
// The widest robot that passes from a scene's start to its goal.
#pragma once

#include <cstddef>
#include <optional>

#include "apps/planner/clearance/widest.h"
#include "apps/planner/turning/turning_search.h"

namespace nef::planner {

/// How a search for the widest robot is limited.
struct WidestLimits {
  Rational precision{1, 1000};                        ///< relative width of the interval
  std::size_t max_cells = TurningLimits().max_cells;  ///< for a robot that turns: cells of angles per size
  std::optional<double> seconds;                      ///< of the whole search; sizes after that are undecided
};

/// The interval in which the size of the widest robot lies, by bisection with an exact answer at each size. The scene's
/// robot becomes that of the size `low`, or of the smallest size that was tried if there is no path. Throws InputError
/// for a scene without a start and a goal, a precision that is not positive, and as `grown` does.
Widest widest_robot(Scene& scene, Growth growth, const WidestLimits& limits = {}, const Monitor& monitor = {});

}  // namespace nef::planner
