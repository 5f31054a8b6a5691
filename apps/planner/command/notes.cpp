// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/notes.h"

#include <iostream>

#include "nef/program/run_program.h"

namespace nef::planner {

void print_notes(const Arguments& a, const Messages& messages) {
  const bool in_report = a.json && a.benchmark.empty();
  if (a.quiet || in_report) return;
  for (const std::string& line : printed_notes(messages)) std::cerr << "planner: " << line << '\n';
}

}  // namespace nef::planner
