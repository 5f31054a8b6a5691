// SPDX-License-Identifier: Apache-2.0
//
// Taking an assembly apart, or proving that nothing of it can leave.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "apps/planner/assembly/parts.h"
#include "apps/planner/assembly/separation.h"
#include "apps/planner/assembly/turning_ways.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Some parts leave those that stay, moving as one; or each in a direction of its own.
struct DisassemblyStep {
  PartSet parts;
  PartSet stay;
  /// Way-points relative to where they began. At the end the boxes of the two are apart. Of a step that turns, the
  /// positions of its poses; of parts that move in different directions, none.
  std::vector<Rational3> path;
  bool straight = false;               ///< one motion, which may go on for ever
  std::vector<std::size_t> unrounded;  ///< way-points with more decimals than were asked for
  std::optional<TurningWay> turning;   ///< how they turn, if they do: every motion is certified
  /// Where each of `parts` goes, straight and all at the same time, if they go in different directions: parts with
  /// equal vectors stay together, and any others are apart at the end. Empty otherwise.
  std::vector<Rational3> vectors;
};

/// Parts of which no set can leave the others, which is proved for all of their sets: by translations, and also with
/// turns if the assembly has a rotation.
struct Inseparable {
  PartSet parts;
  bool nothing_moves = false;  ///< no set of them can begin to move at all
  /// As few of them as are inseparable by themselves: without any one of these, the others of these come apart. That
  /// they hold each other is why `parts` do not come apart.
  PartSet interlocked;
  bool interlocked_is_least = true;  ///< false: the search for fewer was stopped
  /// (a, b): b is in the way of a in some direction of those tried.
  std::vector<std::pair<std::size_t, std::size_t>> blocked_by;
};

/// Parts about which the search was stopped, or about which it found no answer.
struct Undecided {
  PartSet parts;
  std::size_t proved_below = 1;  ///< no set of fewer parts than this can leave the others
};

/// What came of taking parts apart.
struct Disassembly {
  std::vector<DisassemblyStep> steps;    ///< in order, also those before something stuck
  std::vector<Inseparable> inseparable;  ///< none, and none undecided: all parts are apart at the end
  std::vector<Undecided> undecided;      ///< only if the search was stopped, or if parts may turn
  std::optional<std::pair<std::size_t, std::size_t>>
      overlap;  ///< two parts that overlap at the beginning: nothing done
};

/// What is asked.
struct DisassemblyOptions {
  /// Way-points have at most so many decimals where that is free, ends always. (Not those of poses.)
  std::optional<unsigned> digits;
  /// Where no set of parts that moves as one can leave the others, try parts that move at once in different directions.
  bool simultaneous = false;
  /// How far each set of parts that may turn is followed (TurningWayLimits).
  std::size_t max_cells = TurningWayLimits().max_cells;
};

/// Takes parts or subassemblies away, one after the other, until all are apart or what remains is stuck. What is taken
/// away together comes apart afterwards. Contact is allowed everywhere. Nothing is lost by the order: what can leave a
/// set of parts can leave each of its subsets, so a step that is possible stays possible.
///
/// A step first looks for a part that leaves by one straight motion to infinity, along one of the directions in which
/// it can begin to move; then, in each of a finite number of directions (blocking.h), for whatever the graph of who
/// blocks whom does not tie together [Wilson, Latombe 1994]. If there is none, sets of parts are looked for by who has
/// to come along (separation.h), where a set may leave if it can begin to move (first_motions.h), and if the component
/// of its exact free space is unbounded (ways_out.h). So the answer is about all sets of parts, however many parts
/// there are.
///
/// If the assembly has a rotation, sets that translations do not part are tried with turns, too, fewer parts first
/// (turning_ways.h). `inseparable` is then said only if it is proved for all sets and rotations, otherwise `undecided`.
/// It is about sets that move as one, also if parts that move in different directions were tried.
///
/// What is not decided when the monitor stops the search is `undecided`; it is told of steps.
Disassembly take_apart(const Assembly& assembly, const DisassemblyOptions& options = {}, const Monitor& monitor = {});

}  // namespace nef::planner
