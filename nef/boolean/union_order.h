// SPDX-License-Identifier: Apache-2.0
//
// In which order many sets are united.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/forward.h"
#include "nef/geometry/search/box_tree.h"

namespace nef {

/// What an order of unions asks of a set.
struct UnionOperand {
  Box box;                 ///< around its boundary
  std::size_t weight = 1;  ///< what one copy of it costs; not 0
  bool bounded = true;     ///< otherwise its box says nothing
};

/// What a set is to an order.
UnionOperand union_operand(const Polyhedron& set);

/// Unions of two, as a tree over all operands: neighbours first, so that what a union copies is seldom more than what
/// it is about. Halves of equal weight lie on either side of a plane; a set that outweighs the others around it waits
/// for their union, and unbounded sets for that of all others. It depends on the operands and their order alone.
class UnionOrder {
 public:
  /// So many tasks that threads which finish early find another one; a constant, so that the order does not depend on
  /// the number of threads.
  static constexpr std::size_t kTasks = 128;

  /// Of at least one operand; a task has at most the weight of all by `tasks`. O(n log n).
  explicit UnionOrder(std::span<const UnionOperand> operands, std::size_t tasks = kTasks);

  /// A union of two: operands by their numbers, results of step k as (number of operands) + k.
  struct Step {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
  };
  /// All of them; each one after those whose results it needs. The last one makes the union of all.
  [[nodiscard]] std::span<const Step> steps() const { return steps_; }

  /// Steps first .. last - 1, which need nothing from other steps; all but the last are needed by these alone.
  struct Task {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };
  /// Enough of them to keep many threads busy, if there are enough operands. Every step that is in none is in a round.
  [[nodiscard]] std::span<const Task> tasks() const { return tasks_; }
  /// The other steps: those of a round need nothing of each other, but tasks and earlier rounds.
  [[nodiscard]] std::span<const std::vector<std::uint32_t>> rounds() const { return rounds_; }

 private:
  struct Group {
    std::uint32_t result = 0;  // as in Step
    std::size_t round = 0;     // 0 for an operand or a task
  };

  Group order(std::span<std::uint32_t> group);
  [[nodiscard]] std::size_t split(std::span<std::uint32_t> group, std::size_t weight) const;
  [[nodiscard]] std::size_t weight(std::span<const std::uint32_t> group) const;

  std::span<const UnionOperand> operands_;
  std::size_t weight_of_task_ = 0;
  std::vector<Step> steps_;
  std::vector<Task> tasks_;
  std::vector<std::vector<std::uint32_t>> rounds_;
};

}  // namespace nef
