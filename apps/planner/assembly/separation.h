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

/// Whether `moving` can move away from `stay` when all other parts are left out. Must be symmetric in its arguments,
/// and what is true for some parts must be true for fewer of them.
using Separates = std::function<bool(const PartSet& moving, const PartSet& stay)>;

/// The search for a set that all tests let go. A test that says no is asked about ever fewer parts, until both of its
/// sets are as small as can be; this *core* then rules out every set that holds the one side of it and nothing of the
/// other. The search begins with single parts and adds a part only where a core says that one of a few has to come
/// along. So a set is asked about only if all cores so far let it go, and the search is complete: whoever can leave is
/// found, or a smaller set.
class SeparationSearch {
 public:
  /// At least two parts. `tests` should be in the order of their costs; they must outlive the search.
  SeparationSearch(const PartSet& parts, std::span<const Separates> tests) : parts_(parts), tests_(tests) {}

  /// A set of the fewest parts, at most half of all, that can leave the others; nothing if no set can, which is a
  /// proof. Exponential in the number of parts at worst; the number of cores decides. What a test throws ends the
  /// search.
  std::optional<PartSet> run();

  /// No set of fewer parts can leave: known also if run() was left by an exception.
  [[nodiscard]] std::size_t proved_below() const { return proved_below_; }
  /// How often tests were asked.
  [[nodiscard]] std::size_t questions() const { return questions_; }

 private:
  /// If all of `moving` moves, something of `stay` has to, too.
  struct Core {
    PartSet moving;
    PartSet stay;
  };
  bool ask(const Separates& test, const PartSet& moving, const PartSet& stay);
  bool separates(const PartSet& moving);
  void learn(const Separates& test, PartSet moving, PartSet stay);
  [[nodiscard]] std::optional<PartSet> parts_wanted(const PartSet& moving, const PartSet& fixed) const;

  PartSet parts_;
  std::span<const Separates> tests_;
  std::vector<Core> cores_;
  std::size_t proved_below_ = 1;
  std::size_t questions_ = 0;
};

}  // namespace nef::planner
