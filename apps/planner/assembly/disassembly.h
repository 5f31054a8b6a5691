// SPDX-License-Identifier: Apache-2.0
//
// Taking an assembly apart by translations, or proving that nothing of it can leave.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "apps/planner/assembly/parts.h"
#include "apps/planner/assembly/separation.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Some parts leave those that stay, moving as one.
struct DisassemblyStep {
  PartSet parts;
  PartSet stay;
  /// Way-points relative to where they began. At the end the boxes of the two are apart.
  std::vector<Rational3> path;
  bool straight = false;               ///< one motion, which may go on for ever
  std::vector<std::size_t> unrounded;  ///< way-points with more decimals than were asked for
};

/// Parts of which no set can leave the others, which is proved for all of their sets.
struct Inseparable {
  PartSet parts;
  bool nothing_moves = false;  ///< no set of them can begin to move at all
  /// (a, b): b is in the way of a in some direction of those tried.
  std::vector<std::pair<std::size_t, std::size_t>> blocked_by;
};

/// Parts about which the search was stopped.
struct Undecided {
  PartSet parts;
  std::size_t proved_below = 1;  ///< no set of fewer parts than this can leave the others
};

/// What came of taking parts apart.
struct Disassembly {
  std::vector<DisassemblyStep> steps;    ///< in order, also those before something stuck
  std::vector<Inseparable> inseparable;  ///< none, and none undecided: all parts are apart at the end
  std::vector<Undecided> undecided;      ///< only if the search was stopped
  std::optional<std::pair<std::size_t, std::size_t>>
      overlap;  ///< two parts that overlap at the beginning: nothing done
};

/// Takes parts or subassemblies away, one after the other, until all are apart or what remains is stuck. What is taken
/// away together comes apart afterwards. Contact is allowed everywhere. Nothing is lost by the order: what can leave a
/// set of parts can leave each of its subsets, so a step that is possible stays possible.
///
/// A step first looks for a straight motion to infinity: in each of a finite number of directions (blocking.h) whatever
/// the graph of who blocks whom does not tie together can leave [Wilson, Latombe 1994]. If there is none, sets of parts
/// are looked for by who has to come along (separation.h), where a set may leave if it can begin to move, and if the
/// component of its exact free space is unbounded. The free positions of a set are those that all pairs of one moving
/// and one resting part have in common, so there is one sum for each pair of parts however many sets are asked about.
///
/// Way-points have at most so many decimals, `digits`, where that is free, ends always. What is not decided when the
/// monitor stops the search is `undecided`; it is told of steps.
Disassembly take_apart(const Assembly& assembly, const std::optional<unsigned>& digits = std::nullopt,
                       const Monitor& monitor = {});

}  // namespace nef::planner
