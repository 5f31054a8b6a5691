// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/sum/pair_sums.h"

#include <algorithm>

#include "apps/minkowski/part_of_sum.h"
#include "apps/minkowski/union/union_builder.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::minkowski {
namespace {

ConvexCell sum_of_pair(const Product& product, std::size_t pair, const Monitor& monitor) {
  const auto& [a, b] = product;
  const std::size_t i = pair / b.size();
  const std::size_t j = pair % b.size();
  if (a.cell(i).dimension == 3 && b.cell(j).dimension == 3) return convex_sum(a.diagram(i), b.diagram(j), monitor);
  return convex_sum(a.cell(i), b.cell(j), monitor);
}

// The sums of the pairs first, first + 1, ..., on several threads.
std::vector<ConvexCell> sums_of_pairs(const Product& product, std::size_t first, std::size_t count,
                                      const MinkowskiOptions& options, MinkowskiReport& report) {
  const PhaseTimer phase(report.seconds_convex_sums, report.predicates_convex_sums, options.monitor);
  std::vector<ConvexCell> sums(count);
  parallel_for(count, phase.monitor(),
               [&](std::size_t k, const Monitor& own) { sums[k] = sum_of_pair(product, first + k, own); });
  return sums;
}

}  // namespace

Operand::Operand(std::vector<ConvexCell> cells) : cells_(std::move(cells)) {
  diagrams_.reserve(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].dimension < 3) continue;
    NEF_ASSERT(diagrams_.size() == i);
    diagrams_.emplace_back(cells_[i]);
  }
}

Polyhedron union_of_pair_sums(std::span<const Product> products, const MinkowskiOptions& options,
                              MinkowskiReport& report) {
  constexpr std::size_t kBlock = 256;
  std::size_t all = 0;
  for (const Product& product : products) all += product.a.size() * product.b.size();
  report.pairs += all;
  const PartOfSum whole(options.monitor);
  double seconds = 0;  // of the sums of pairs, too; seconds_union gets those of the union only
  const PhaseTimer union_phase(seconds, report.predicates_union, whole.monitor());
  UnionBuilder builder(all, union_phase.monitor());
  for (const Product& product : products) {
    const std::size_t pairs = product.a.size() * product.b.size();
    for (std::size_t first = 0; first < pairs; first += kBlock) {
      std::vector<ConvexCell> sums = sums_of_pairs(product, first, std::min(kBlock, pairs - first), options, report);
      const Stopwatch watch;
      for (ConvexCell& sum : sums) builder.add(std::move(sum));  // in order, whoever made them
      report.seconds_union += watch.seconds();
    }
  }
  const Stopwatch watch;
  Polyhedron result = builder.finish();
  whole.monitor().tell_progress(kSumPhase, 1, 1);
  report.seconds_union += watch.seconds();
  report.pairs_dropped += builder.dropped();
  report.united_at_once += builder.united_at_once();
  report.united_two_by_two += builder.united_two_by_two();
  return result;
}

}  // namespace nef::minkowski
