// SPDX-License-Identifier: Apache-2.0
//
// What a run found, in each form that may be asked for, and how it is told.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/command/arguments.h"
#include "apps/program/reports/run_report.h"
#include "apps/view/layer.h"

namespace nef::planner {

/// Functions are called if and when something wants what they make.
struct Findings {
  std::string command;               ///< as the report names it
  std::string title;                 ///< of pages
  std::function<Json()> report;      ///< the members of the report
  std::vector<ReportPhase> phases;   ///< of the report
  std::function<void()> for_people;  ///< prints on standard output
  /// What a file of -o with another extension holds; nothing: it is not written. Without it, no such file is.
  std::function<std::optional<std::string>(const std::string& extension)> text = nullptr;
  /// What pages and .glb files show. Without it, there are none.
  std::function<std::vector<view::Layer>()> layers = nullptr;
};

/// Writes the files of -o and --page, and prints the report with --json, else, unless --quiet, what is for people.
/// Throws InputError where a file cannot be written.
void tell(const Arguments& a, const Findings& findings);

/// True for a file to look at: a page (.html) or a glTF file (.glb).
bool is_view_file(const std::string& file);

}  // namespace nef::planner
