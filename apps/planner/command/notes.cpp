// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/notes.h"

#include <iostream>

namespace nef::planner {

void print_notes(const Arguments& a, const Messages& messages) {
  const bool in_report = a.json && a.benchmark.empty();
  if (a.quiet || in_report) return;
  constexpr std::size_t kMost = 10;
  constexpr std::size_t kShown = 5;
  const std::size_t shown = messages.size() > kMost ? kShown : messages.size();
  for (std::size_t i = 0; i < shown; ++i) std::cerr << "planner: note: " << messages[i] << '\n';
  if (shown < messages.size()) {
    std::cerr << "planner: note: and " << messages.size() - shown << " more of them (--json lists all)\n";
  }
}

}  // namespace nef::planner
