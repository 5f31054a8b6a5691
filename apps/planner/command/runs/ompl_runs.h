// SPDX-License-Identifier: Apache-2.0
//
// OMPL's own planners on the exact free space, and benchmarks of them beside ours.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/command/arguments.h"
#include "apps/planner/path/question.h"
#include "apps/planner/rigid_search/rigid_planning.h"
#include "apps/planner/turning/turning_search.h"

namespace nef::planner {

/// The time of each run, unless --time gives another one.
inline constexpr double kOmplSeconds = 10;

/// What a robot that turns is told after the planner's name.
inline constexpr const char* kNoPathInTime =
    " found no path in time, which proves nothing (without --ompl: a path, or a proof that there is none)";

struct OmplRequest {
  std::string planner;
  double seconds = kOmplSeconds;
  unsigned runs = 1;
  std::optional<unsigned> digits = std::nullopt;  ///< round way-points to so many decimals where the motions stay free
};

struct OmplOutcome {
  Answer answer;        ///< the best path over all runs
  std::string summary;  ///< one line for people
  unsigned solved = 0;
  int exit_code = 4;  ///< 0 if a run was solved; 1 if our planner proved infeasibility; 3; 4 no answer in time
};

/// Runs a planner. Its paths are checked exactly again before they count. Throws Interrupted if the monitor stops it.
OmplOutcome run_ompl(const Problem& problem, const OmplRequest& request, const Monitor& monitor = {});

/// Runs a planner on the question of a scene with a rotation. kUndecided: no answer in time. Its path is checked again;
/// between two way-points the robot may move and turn at once. Throws Interrupted if the monitor stops it.
TurningAnswer run_turning_ompl(const Scene& scene, const std::string& planner, double seconds,
                               const Monitor& monitor = {});

/// Runs a planner on the question of a scene whose robot turns freely; `checker` must be that of the scene. kPath:
/// every motion was certified once more. kUndecided: no answer in time. Throws Interrupted if the monitor stops it, and
/// InputError if the start or the goal is free but not in OMPL's doubles.
RigidAnswer run_rigid_ompl(const Scene& scene, const std::shared_ptr<const MotionChecker>& checker,
                           const std::string& planner, double seconds, const Monitor& monitor = {});

/// Writes OMPL's benchmark log (for ompl_benchmark_statistics): our planner and those of --planners. Returns the exit
/// code: 0, or 3 if start or goal is not free. Throws InputError if one is missing. TightPlanner's runs include the
/// construction of the free space from the scene.
int run_benchmark(const Problem& problem, const Arguments& a);

}  // namespace nef::planner
