// SPDX-License-Identifier: Apache-2.0
//
// What the command line of `minkowski` says.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/minkowski/minkowski.h"

namespace nef::minkowski {

/// The parsed command line.
struct Arguments {
  std::vector<std::string> operands;
  std::string output, report, preview;
  std::string union_name = "nary";
  bool open_a = false, open_b = false, negate_b = false;
  bool as_surface = false, strict = false;
  unsigned threads = 0;  ///< 0: as many as the machine has
  bool exact = false, binary = false, text = false, quiet = false, json = false;

  std::string ball, box_tool;  ///< as written: "R,N", "x,y,z"
  bool decompose = false;
  std::string format;  ///< of the files in a directory of cells; empty: off

  bool configuration_space = false;
  std::string robot;
  std::vector<std::string> obstacles;
  std::vector<std::string> box;  ///< two corners "x,y,z"
};

/// Declares all options.
void declare(CLI::App& app, Arguments& arguments);

/// Checks what CLI11 cannot: which options go together. Throws InputError.
void check(const Arguments& arguments);

UnionStrategy strategy(const Arguments& arguments);

}  // namespace nef::minkowski
