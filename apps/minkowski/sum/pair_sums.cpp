// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/sum/pair_sums.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/base/parallel.h"

namespace nef::minkowski {
namespace {

ConvexCell sum_of_pair(const Operand& a, std::size_t i, const Operand& b, std::size_t j) {
  if (a.cell(i).dimension == 3 && b.cell(j).dimension == 3) return convex_sum(a.diagram(i), b.diagram(j));
  return convex_sum(a.cell(i), b.cell(j));
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

void PairSums::add_product(const Operand& a, const Operand& b) {
  products_.emplace_back(&a, &b);
  report_.pairs += a.size() * b.size();
}

// Sums of a block of pairs are made at once, on several threads; they go into the union in order.
Polyhedron PairSums::run() {
  std::size_t done = 0;
  const auto poll = [&] {
    if (options_.progress && !options_.progress(done, report_.pairs)) throw Cancelled();
  };
  UnionBuilder builder(options_.strategy, options_.threads, poll);
  constexpr std::size_t kBlock = 256;
  std::vector<ConvexCell> block;
  for (const auto& product : products_) {
    const Operand& a = *product.first;
    const Operand& b = *product.second;
    const std::size_t pairs = a.size() * b.size();
    for (std::size_t first = 0; first < pairs; first += kBlock) {
      block.assign(std::min(kBlock, pairs - first), {});
      {
        const PhaseTimer timer(report_.seconds_convex_sums, report_.predicates_convex_sums);
        parallel_for(block.size(), options_.threads, [&](std::size_t k) {
          block[k] = sum_of_pair(a, (first + k) / b.size(), b, (first + k) % b.size());
        });
      }
      const PhaseTimer timer(report_.seconds_union, report_.predicates_union);
      for (ConvexCell& sum : block) {
        builder.add(std::move(sum));
        ++done;
        poll();
      }
    }
  }
  const PhaseTimer timer(report_.seconds_union, report_.predicates_union);
  Polyhedron result = builder.finish();
  report_.pairs_dropped += builder.dropped();
  return result;
}

}  // namespace nef::minkowski
