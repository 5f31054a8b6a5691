// SPDX-License-Identifier: Apache-2.0
//
// Finds a set of parts that can leave the others, or proves that no set can, without asking about every set.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace nef::planner {

/// Indices of parts, ascending.
using PartSet = std::vector<std::size_t>;

/// The parts of `all` that are not in `some`.
PartSet without(const PartSet& all, const PartSet& some);

/// If all of `moving` moves, something of `stay` has to, too, as long as both are there.
struct Core {
  PartSet moving;
  PartSet stay;
  std::size_t test = 0;  ///< the number of the test that said so
};

/// Nothing if `moving` can move away from `stay` when all other parts are left out; otherwise parts of both that hold
/// each other already, or just both. What is possible must be so with both sides exchanged, and for fewer parts.
using HeldBy = std::function<std::optional<Core>(const PartSet& moving, const PartSet& stay)>;

/// The search for a set that all tests let go. A test that says no is asked about ever fewer parts, until both of its
/// sets are as small as can be; this *core* then rules out every set that holds the one side of it and nothing of the
/// other. The search begins with single parts and adds a part only where a core says that one of a few has to come
/// along. So a set is asked about only if all cores so far let it go, and the search is complete: whoever can leave is
/// found, or a smaller set.
class SeparationSearch {
 public:
  /// At least two parts. `tests` should be in the order of their costs; they must outlive the search. `known` are cores
  /// of an earlier search; those with other parts than these say nothing and are left out.
  SeparationSearch(const PartSet& parts, std::span<const HeldBy> tests, std::span<const Core> known = {});

  /// A set of the fewest parts, at most half of all, that can leave the others; nothing if no set can, which is a
  /// proof. Exponential in the number of parts at worst; the number of cores decides. What a test throws ends the
  /// search.
  std::optional<PartSet> run();

  /// No set of fewer parts can leave: known also if run() was left by an exception.
  [[nodiscard]] std::size_t proved_below() const { return proved_below_; }
  /// Cores that were found, each with the same one with its sides exchanged. Known also if run() was left.
  [[nodiscard]] std::span<const Core> found() const { return std::span(cores_).subspan(known_); }
  /// How often tests were asked.
  [[nodiscard]] std::size_t questions() const { return questions_; }

 private:
  std::optional<Core> ask(std::size_t test, const PartSet& moving, const PartSet& stay);
  bool separates(const PartSet& moving);
  void shrink(Core& core, PartSet Core::*side);
  void learn(Core core);
  [[nodiscard]] std::optional<PartSet> parts_wanted(const PartSet& moving, const PartSet& fixed) const;

  PartSet parts_;
  std::span<const HeldBy> tests_;
  std::vector<Core> cores_;
  std::size_t known_ = 0;  // of the cores
  std::size_t proved_below_ = 1;
  std::size_t questions_ = 0;
};

}  // namespace nef::planner
