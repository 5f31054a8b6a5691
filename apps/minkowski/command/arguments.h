// SPDX-License-Identifier: Apache-2.0
//
// What the command line of `minkowski` says.
#pragma once

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "apps/program/session.h"

namespace nef::minkowski {

/// What is to be done.
enum class Task : std::uint8_t {
  kSum,
  kErode,
  kOpen,
  kClose,
  kOffset,
  kSweep,
  kHull,
  kNoFit,
  kPenetration,
  kReach,
  kMillable,
  kConfigurationSpace,
  kDecompose
};

/// The parsed command line: what all programs have in `session`, the operands and their changes.
struct Arguments {
  std::vector<std::string> operands;
  Session session{"minkowski", std::cout, std::cerr};
  std::string preview;
  std::string union_name = "auto";
  bool open_a = false, open_b = false, negate_b = false, hull_b = false;
  bool exact_volume = false;

  std::string ball, box_tool;  ///< as written: "R,N", "x,y,z"
  bool inner = false, outer = false;
  bool erode = false, open = false, close = false, hull = false, no_fit = false, penetration = false, reach = false;
  bool millable = false;
  int axes = 0;               ///< of --millable; 0: not given
  std::string offset;         ///< "R" or "R,N"
  std::size_t decimate = 0;   ///< triangles of the offset; 0: not given
  std::optional<int> digits;  ///< decimals of the offset
  std::vector<std::string> sweep;
  std::string from, touched, untouched, labels;
  bool decompose = false;
  std::string format;  ///< of the files in a directory of cells; empty: off

  std::string memory;  ///< for tiles; empty: not given

  bool configuration_space = false;
  std::string robot;
  std::vector<std::string> obstacles;
  std::string box;  ///< "x0,y0,z0,x1,y1,z1"
};

/// Declares all options.
void declare(CLI::App& app, Arguments& arguments);

/// The task that is asked for. Checks what CLI11 cannot: which options go together. Throws InputError.
Task check(const Arguments& arguments);

/// The name of a task in reports and of its result in pictures.
std::string name(Task task);

UnionStrategy strategy(const Arguments& arguments);

}  // namespace nef::minkowski
