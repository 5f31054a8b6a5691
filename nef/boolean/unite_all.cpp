// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <vector>

#include "nef/base/threads/parallel.h"
#include "nef/boolean/union_order.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

// The unions of an order, each by whichever thread.
class UnionRun {
 public:
  explicit UnionRun(std::vector<Polyhedron>&& sets)
      : sets_(std::move(sets)), operands_(measured(sets_)), order_(operands_), alone_(order_.steps().size() == 1) {}

  Polyhedron result(const Monitor& monitor) {
    const auto steps = static_cast<std::uint32_t>(order_.steps().size());
    sets_.resize(operands_.size() + steps);
    if (monitor.threads() == 1) {
      run({0, steps}, monitor);
      return sets_.back();
    }
    parallel_for(order_.tasks().size(), monitor,
                 [this](std::size_t i, const Monitor& own) { run(order_.tasks()[i], own); });
    // The last unions are large and few: threads that find none of their own help with those of others.
    constexpr std::size_t kFew = 8;
    for (const std::vector<std::uint32_t>& round : order_.rounds()) {
      parallel_for(round.size(), monitor, [&](std::size_t i, const Monitor& own) {
        run({round[i], round[i] + 1}, round.size() < kFew ? own.on_threads(monitor.threads()) : own);
      });
    }
    return sets_.back();
  }

 private:
  static std::vector<UnionOperand> measured(const std::vector<Polyhedron>& sets) {
    std::vector<UnionOperand> result;
    result.reserve(sets.size());
    for (const Polyhedron& set : sets) result.push_back(union_operand(set));
    return result;
  }

  void run(const UnionOrder::Task& task, const Monitor& own) {
    // Many small operations tell of themselves as one; a single one, of what it does.
    const Monitor of_step = alone_ ? own : own.quiet();
    for (std::uint32_t k = task.first; k < task.last; ++k) {
      Polyhedron& a = sets_[order_.steps()[k].first];
      Polyhedron& b = sets_[order_.steps()[k].second];
      sets_[operands_.size() + k] = unite(a, b, of_step);
      a = b = Polyhedron();
      if (!alone_) own.tell_progress("sets", ++done_, order_.steps().size());
    }
  }

  std::vector<Polyhedron> sets_;  // operands and, behind them, results; those that were used are gone
  std::vector<UnionOperand> operands_;
  UnionOrder order_;
  bool alone_;
  std::atomic<std::size_t> done_ = 0;
};

}  // namespace

Polyhedron unite_all(std::span<const Polyhedron> sets, const Monitor& monitor) {
  std::vector<Polyhedron> left;
  left.reserve(sets.size());
  for (const Polyhedron& set : sets) {
    if (set.is_everything()) return without_labels(set, monitor);
    if (!set.is_empty()) left.push_back(set);
  }
  if (left.empty()) return {};
  if (left.size() == 1) return without_labels(left.front(), monitor);
  std::size_t vertices = 0;
  for (const Polyhedron& set : left) vertices += set.complex().vertex_count();
  constexpr std::size_t kFewSets = 8;
  const Monitor of_run = left.size() < kFewSets ? for_vertices(vertices, monitor) : monitor;
  return UnionRun(std::move(left)).result(of_run);
}

}  // namespace nef
