// SPDX-License-Identifier: Apache-2.0
//
// Operands with missing points, edges or facets inside are filled first, which changes no sum. Then the reduced
// convolution is arranged (`surviving_intervals`), and the regions are found and put together
// (`sum_of_regions`). What the method does not cover is declined with its reason, and the caller sums cells instead.
#include "apps/minkowski/convolution/convolution_sum.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/minkowski/convolution/convolution_regions.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/part_of_sum.h"
#include "nef/base/defect.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::minkowski {

bool has_convolution(const Polyhedron& a) { return !a.is_empty() && a.is_bounded() && is_full_dimensional(a); }

bool have_closed_convolution(const Polyhedron& a, const Polyhedron& b) {
  const auto is_body = [](const Polyhedron& set) { return !set.is_empty() && set.is_bounded() && set.is_closed(); };
  return is_body(a) && is_body(b) && (is_full_dimensional(a) || is_full_dimensional(b));
}

namespace {

// How many pairs of facets of the convolution lie in one plane upon each other, since they are sums of pieces of the
// same two parallel facets. Only marks need them; else the sum of the two facets is one polygon. O(facets of A times
// facets of B).
std::size_t stacked_pairs(const SolidFeatures& a, const SolidFeatures& b, const Monitor& monitor) {
  std::size_t pairs = 0;
  for (const SolidFacet& f : a.facets()) {
    for (const SolidFacet& g : b.facets()) {
      const std::size_t sums = f.pieces.size() * g.pieces.size();
      if (sums > 1 && same_direction(a.normal(f.plane), b.normal(g.plane), monitor)) pairs += sums * (sums - 1) / 2;
    }
  }
  return pairs;
}

// Measured: a pair takes 0.5 microseconds.
constexpr std::size_t kMostStackedPairs = std::size_t{1} << 22U;

// Measured on combs, frames, crosses and pots with balls of 66 to 1026 vertices: from so many facets for each pair of
// cells on, sums of cells take .5 to .9 of the time. Of many pairs that overlap it is not true.
constexpr std::size_t kFacetsPerPair = 250;

}  // namespace

std::optional<Polyhedron> convolution_sum(Summand& summand_a, Summand& summand_b, bool only_if_fast,
                                          ConvolutionReport& report, const Monitor& monitor) {
  const auto decline = [&report](std::string why) {
    report.why = std::move(why);
    return std::nullopt;
  };
  if (only_if_fast && summand_a.is_convex(monitor) && summand_b.is_convex(monitor))
    return decline("both operands are convex");
  const Polyhedron& a = summand_a.filled(monitor);
  const Polyhedron& b = summand_b.filled(monitor);
  const SolidFeatures& of_a = summand_a.features(monitor);
  const SolidFeatures& of_b = summand_b.features(monitor);
  report.pairs_of_cells = of_a.cells() * of_b.cells();
  if (only_if_fast && marks_of_sum(of_a.marks(), of_b.marks()) == BoundaryMarks::kMixed) {
    const std::size_t stacked = stacked_pairs(of_a, of_b, monitor);
    if (stacked > kMostStackedPairs)
      return decline("parts of the boundary are missing, and " + std::to_string(stacked) +
                     " pairs of convolution facets would lie in one plane");
  }
  const SumMembership membership(a, summand_b.turned(monitor));
  ConvolutionFacets facets;
  parallel_calls(monitor, {[&](const Monitor& own) { facets = reduced_convolution(of_a, of_b, own); },
                           [&](const Monitor& own) { membership.prepare(own); }});
  report.facets = facets.size();
  if (only_if_fast && report.pairs_of_cells <= kFewPairsOfCells &&
      facets.size() >= kFacetsPerPair * report.pairs_of_cells) {
    report.is_put_off = true;
    return decline("the convolution has many facets for so few pairs of cells");
  }
  const bool is_closed = facets.marks == BoundaryMarks::kAll;
  std::vector<SaddlePoint> saddles;
  if (!is_closed && !(of_a.has_plain_facets() && of_b.has_plain_facets())) {
    return decline("a single point in a facet is marked unlike it");
  }
  if (!is_closed && !summand_a.has_convex_closure(monitor) && !summand_b.has_convex_closure(monitor)) {
    if (!of_a.has_simple_edges() || !of_b.has_simple_edges()) {
      return decline("an edge has several wedges, neither operand is convex, and one is not closed");
    }
    saddles =
        saddle_points(summand_a.saddles(monitor), summand_b.saddles(monitor), membership, facets.covered, monitor);
  }
  // Shares of the time are measured, for the bar only.
  constexpr double kOfIntervals = 0.2;
  std::optional<RoundedFacets> in_doubles;
  std::optional<BoxTree> boxes;
  std::optional<SharedSides> sides;
  parallel_calls(monitor, {[&](const Monitor& own) {
                             in_doubles.emplace(facets, own);
                             boxes.emplace(in_doubles->boxes());
                           },
                           [&](const Monitor&) { sides.emplace(facets); }});
  const RoundedFacets& rounded = *in_doubles;
  const SharedSides& at_side = *sides;
  if (!rounded.are_proven()) return decline("coordinates are too large or too small for doubles");
  const PartOfSum first(monitor, 0, kOfIntervals);
  const SurvivingIntervals intervals =
      surviving_intervals(facets, rounded, *boxes, at_side, membership, !is_closed, first.monitor());
  const PartOfSum second(monitor, kOfIntervals, 1);
  SumOfRegions made =
      sum_of_regions(facets, rounded, *boxes, at_side, intervals, membership, saddles, second.monitor());
  // Synthesis checks what it is given, but not all that wrong marks on the boundary would lead to: a facet whose border
  // turns the wrong way. Where all of the boundary is in the sum, or nothing of it is and it has no passages, there are
  // no such marks.
  if (facets.marks == BoundaryMarks::kMixed || made.passages > 0) {
    const std::string broken = validate(made.sum, monitor);
    if (!broken.empty()) {
      throw detail::BrokenInvariant({Defect::Kind::kStructure, "a sum by convolution is a set: " + broken, {}});
    }
  }
  const bool solid = has_convolution(a) && has_convolution(b);
  report.why = solid ? "both operands are solid" : "both operands are closed, and one is solid";
  report.segments = intervals.segments.size();
  report.intervals = intervals.intervals.size();
  report.points = made.points;
  report.regions = made.tested;
  return Polyhedron(std::move(made.sum));
}

}  // namespace nef::minkowski
