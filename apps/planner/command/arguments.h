// SPDX-License-Identifier: Apache-2.0
//
// What can be said to the command `planner`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/planner/clearance/timing.h"
#include "apps/planner/path/path.h"
#include "nef/program/common_options.h"

namespace nef::planner {

/// The command line. Options are described by `planner --help`.
struct Arguments {
  std::string scene;
  std::string assembly;
  std::string free_directions;
  std::vector<std::string> outputs;
  std::string page;
  std::string start;
  std::string goal;
  std::string contact;
  std::string prefer = "short";
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
  double seconds = 10;
  bool time_given = false;
  std::size_t max_cells = 2000;
  unsigned runs = 1;
  unsigned threads = 0;
  bool tight = false;
  bool json = false;
  bool se3 = false;
  bool quiet = false;
  MeshFileFlags mesh_file;
};

/// Throws InputError if flags of mesh files are given and no such file is written.
void check_mesh_flags(const Arguments& arguments);

/// Declares all options; parsing fills `arguments`, which must live until then.
void declare(CLI::App& app, Arguments& arguments);

}  // namespace nef::planner
