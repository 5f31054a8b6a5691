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
StrategyChoice choice_of_cells(std::size_t two_by_two, std::string why) {
  if (two_by_two != 0) {
    why += "; " + std::to_string(two_by_two) + (two_by_two == 1 ? " sum of cells is" : " sums of cells are") +
           " flat, have many vertices, or nearly coincide with others";
  }
  return {"queue", std::move(why)};
}

}  // namespace

std::optional<Polyhedron> sum_by_convolution(Summand& a, Summand& b, const MinkowskiOptions& options,
                                             MinkowskiReport& report, std::string& why) {
  const bool insist = options.strategy == UnionStrategy::kConvolution;
  why = "requested";
  if (!insist && options.strategy != UnionStrategy::kAuto) return std::nullopt;
  const PhaseTimer phase(report.seconds_union, report.predicates_union, options.monitor);
  for (const Summand* summand : {&a, &b}) {
    if (has_convolution(summand->set()) || have_closed_convolution(a.set(), b.set())) continue;
    why = std::string(summand == &a ? "A" : "B") +
          " has parts that are not solid; then both must be closed, and one solid";
    return std::nullopt;
  }
  const PartOfSum whole(phase.monitor());
  ConvolutionReport counts;
  std::optional<Polyhedron> sum = convolution_sum(a, b, !insist, counts, whole.monitor());
  if (!sum || !insist) why = counts.why;
  report.convolution_facets += counts.facets;
  report.convolution_intervals += counts.intervals;
  report.convolution_points += counts.points;
  report.convolution_regions += counts.regions;
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

Polyhedron union_of_pair_sums_for(std::string why, std::span<const Product> products, const MinkowskiOptions& options,
                                  MinkowskiReport& report) {
  const std::size_t two_by_two = report.united_two_by_two;
  Polyhedron sum = union_of_pair_sums(products, options, report);
  report.choices.push_back(choice_of_cells(report.united_two_by_two - two_by_two, std::move(why)));
  return sum;
}

}  // namespace nef::minkowski
