// SPDX-License-Identifier: Apache-2.0
//
// What can be said to the command `planner`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/clearance/timing.h"
#include "apps/planner/path/path.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turning_search.h"
#include "apps/program/session.h"

namespace nef::planner {

/// The command line: what all programs have in `session`, and the rest. Options are described by `planner --help`.
struct Arguments {
  explicit Arguments(Session& its_session) : session(its_session) {}

  Session& session;
  const CLI::App* app = nullptr;  ///< what was parsed
  std::string scene;
  std::string assembly;
  std::string free_directions;
  std::string range;
  std::string verdict;
  std::string linkage;
  std::string srdf;
  std::vector<std::string> obstacles;  ///< of the linkage
  bool exact = false;
  bool simultaneous = false;
  std::vector<std::string> outputs;
  std::string page;
  std::string start;
  std::string goal;
  std::optional<ContactRule> contact;
  std::string given_path;
  std::string queries;
  std::string proof;
  std::string check_proof;
  std::string keep_clear;
  std::string precision = "1/1000";
  MotionLimits limits{.speed = 0};
  bool widest = false;
  bool widest_box = false;
  std::string ompl;
  std::string benchmark;
  std::vector<std::string> planners{"RRTConnect", "PRMstar", "BITstar"};
  PathOptions path;
  std::optional<double> time;  ///< seconds
  std::size_t max_cells = TurningLimits().max_cells;
  unsigned runs = 1;
  bool tight = false;
  bool se3 = false;
  bool turn_freely = false;
};

/// Throws InputError for options that do not go together, or with the extensions of the files that are to be written,
/// as far as the command line tells. Before any work is done.
void check_usage(const Arguments& arguments);

/// Throws InputError if one of these options was given; `what` is what does not go with it.
void exclude(const Arguments& arguments, const std::string& what, const std::vector<const char*>& options);

/// Throws InputError if a file of -o has none of these extensions, in lower case without a dot; `where` says when.
void require_extensions(const Arguments& arguments, const std::string& where,
                        const std::vector<const char*>& extensions);

/// Declares all options; parsing fills `arguments`. Both `app` and `arguments` must outlive the run.
void declare(CLI::App& app, Arguments& arguments);

}  // namespace nef::planner
