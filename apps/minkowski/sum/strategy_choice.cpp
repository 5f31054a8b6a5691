// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/sum/strategy_choice.h"

#include <algorithm>
#include <utility>

#include "apps/minkowski/convolution/convolution_sum.h"
#include "apps/minkowski/part_of_sum.h"
#include "apps/minkowski/planar/flat_sets.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

// After the reason why there are cells at all.
void tell_of_cells(std::size_t two_by_two, StrategyChoice& choice) {
  choice.chosen = "queue";
  if (two_by_two != 0) {
    choice.why += "; " + std::to_string(two_by_two) + (two_by_two == 1 ? " sum of cells is" : " sums of cells are") +
                  " flat, have many vertices, or nearly coincide with others";
  }
}

std::optional<Polyhedron> counted_convolution(Summand& a, Summand& b, bool only_if_fast, ConvolutionReport& counts,
                                              const Monitor& monitor, MinkowskiReport& report) {
  const PartOfSum whole(monitor);
  std::optional<Polyhedron> sum = convolution_sum(a, b, only_if_fast, counts, whole.monitor());
  report.convolution_facets += counts.facets;
  report.convolution_intervals += counts.intervals;
  report.convolution_points += counts.points;
  report.convolution_regions += counts.regions;
  return sum;
}

}  // namespace

TriedConvolution sum_by_convolution(Summand& a, Summand& b, const MinkowskiOptions& options, MinkowskiReport& report,
                                    StrategyChoice& choice) {
  const bool insist = options.strategy == UnionStrategy::kConvolution;
  choice = {"convolution", "requested"};
  if (!insist && options.strategy != UnionStrategy::kAuto) return {};
  const PhaseTimer phase(report.seconds_union, report.predicates_union, options.monitor);
  for (const Summand* summand : {&a, &b}) {
    if (has_convolution(summand->set()) || have_closed_convolution(a.set(), b.set())) continue;
    choice.why = std::string(summand == &a ? "A" : "B") +
                 " has parts that are not solid; then both must be closed, and one solid";
    return {};
  }
  ConvolutionReport counts;
  TriedConvolution tried;
  tried.sum = counted_convolution(a, b, !insist, counts, phase.monitor(), report);
  tried.is_put_off = counts.is_put_off;
  if (!tried.sum || !insist) choice.why = counts.why;
  choice.pairs_of_cells = counts.pairs_of_cells;
  choice.convolution_facets = counts.facets;
  return tried;
}

std::optional<Polyhedron> sum_by_convolution_after_all(Summand& a, Summand& b, std::size_t pairs_of_cells,
                                                       const MinkowskiOptions& options, MinkowskiReport& report,
                                                       StrategyChoice& choice) {
  constexpr std::size_t kFar = 4;  // times as many as are few
  if (pairs_of_cells <= kFar * kFewPairsOfCells) return std::nullopt;
  const PhaseTimer phase(report.seconds_union, report.predicates_union, options.monitor);
  ConvolutionReport counts;
  std::optional<Polyhedron> sum = counted_convolution(a, b, false, counts, phase.monitor(), report);
  if (sum) {
    choice.why = "there are " + std::to_string(pairs_of_cells) + " pairs of cells, far more than was estimated";
  }
  return sum;
}

std::optional<Polyhedron> flat_sum_by_convolution(const Polyhedron& a, const Polyhedron& b,
                                                  const MinkowskiOptions& options, MinkowskiReport& report) {
  if (options.strategy == UnionStrategy::kQueue) return std::nullopt;
  const PhaseTimer phase(report.seconds_union, report.predicates_union, options.monitor);
  std::optional<Polyhedron> sum = sum_of_flat_sets(a, b, phase.monitor());
  if (sum) report.choices.push_back({"convolution", "both operands are closed polygons in parallel planes"});
  return sum;
}

Polyhedron union_of_pair_sums_for(StrategyChoice choice, std::span<const Product> products,
                                  const MinkowskiOptions& options, MinkowskiReport& report) {
  const std::size_t two_by_two = report.united_two_by_two;
  Polyhedron sum = union_of_pair_sums(products, options, report);
  tell_of_cells(report.united_two_by_two - two_by_two, choice);
  report.choices.push_back(std::move(choice));
  return sum;
}

}  // namespace nef::minkowski
