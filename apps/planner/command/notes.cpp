// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/notes.h"

#include <iostream>

#include "nef/program/notes.h"

namespace nef::planner {

void print_notes(const Arguments& a, const Messages& messages) {
  if (!a.quiet) nef::print_notes(std::cerr, "planner", messages);
}

}  // namespace nef::planner
