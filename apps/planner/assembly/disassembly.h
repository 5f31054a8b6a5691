// SPDX-License-Identifier: Apache-2.0
//
// Taking an assembly apart by translations, or proving that nothing of it can leave.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/planner/assembly/parts.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Indices of parts, ascending.
using PartSet = std::vector<std::size_t>;

/// Some parts leave those that stay, moving as one.
struct DisassemblyStep {
  PartSet parts;
  PartSet stay;
  /// Way-points relative to where they began. At the end the boxes of the two are apart.
  std::vector<Rational3> path;
  bool straight = false;               ///< one motion, which may go on for ever
  std::vector<std::size_t> unrounded;  ///< way-points with more decimals than were asked for
};

/// Parts that do not come apart.
struct Inseparable {
  PartSet parts;
  /// True if the proof covers all subassemblies; else single parts and what the blocking graphs tie together.
  bool all_subassemblies = false;
  bool nothing_moves = false;  ///< no part of it can begin to move at all
  /// (a, b): b is in the way of a in some direction of those tried.
  std::vector<std::pair<std::size_t, std::size_t>> blocked_by;
};

struct Disassembly {
  std::vector<DisassemblyStep> steps;    ///< in order, also those before something stuck
  std::vector<Inseparable> inseparable;  ///< none: all parts are apart at the end
  std::optional<std::pair<std::size_t, std::size_t>>
      overlap;  ///< two parts that overlap at the beginning: nothing done
};

/// How it goes on: called before each step with the number of steps so far.
using DisassemblyProgress = std::function<void(std::size_t steps)>;

/// Takes parts or subassemblies away, one after the other, until all are apart or what remains is stuck. What is taken
/// away together comes apart afterwards. Contact is allowed everywhere.
///
/// A step first looks for a straight motion to infinity: in each of a finite number of directions (blocking.h) whatever
/// the graph of who blocks whom does not tie together can leave [Wilson, Latombe 1994]. If there is none, the complete
/// planner is asked: of a set of up to 8 parts for every subset that can begin to move, of a larger one for single
/// parts and for what the graphs of who blocks whom at once do not tie together. If in every direction those graphs
/// tie all parts together, nothing can begin to move, which is a proof for every subset.
///
/// With `digits`, way-points have at most so many decimals where that is free, ends always.
Disassembly take_apart(const Assembly& assembly, const DisassemblyProgress& progress = {},
                       std::optional<unsigned> digits = std::nullopt, const Monitor& monitor = {});

}  // namespace nef::planner
