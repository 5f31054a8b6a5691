// SPDX-License-Identifier: Apache-2.0
//
// Operands with missing points, edges or facets inside are filled first, which changes no sum. If only fast sums are
// wanted, a cost model compares the pairs of convolution facets that lie in one plane with the pairs of convex cells.
// Then the reduced convolution is arranged (`surviving_intervals`), and the regions are found and put together
// (`sum_of_regions`). What the method does not cover is declined with its reason, and the caller sums cells instead.
#include "apps/minkowski/convolution/convolution_sum.h"

#include <algorithm>
#include <string>
#include <vector>

#include "apps/minkowski/convolution/convolution_regions.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/decomposition/wall_axis.h"
#include "apps/minkowski/minkowski.h"
#include "nef/base/defect.h"

namespace nef::minkowski {

bool has_convolution(const Polyhedron& a) { return !a.is_empty() && a.is_bounded() && is_full_dimensional(a); }

namespace {

// True if all items of the boundary have the inside of the set on one side and nothing of it on another.
bool is_bounded_by_facets(const Complex& c) {
  for (const Facet& f : c.facets) {
    if ((c.volumes[f.volume_above].mark != 0) == (c.volumes[f.volume_below].mark != 0)) return false;
  }
  for (const VertexId v : c.vertex_ids()) {
    const SphereMapView map = c.sphere_map(v);
    if (map.trivial()) return false;
    for (const SVertex& s : map.svertices) {
      if (s.out == kNone) return false;
    }
  }
  return true;
}

// With points, segments and facets that are missing inside: they change no sum of sets that lie in the closures of
// their interiors (see minkowski_sum.cpp).
Polyhedron filled(const Polyhedron& a, const Monitor& monitor) {
  return is_bounded_by_facets(a.complex()) ? a : unite(a, interior(regularize(a, monitor), monitor), 1, monitor);
}

std::string plural(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// How many pairs of facets of the convolution lie in one plane since they are sums of pieces of the same two parallel
// facets: what an arrangement of facets costs where caps meet caps. O(facets of A times facets of B).
std::size_t stacked_pairs(const SolidFeatures& a, const SolidFeatures& b, const Monitor& monitor) {
  std::size_t pairs = 0;
  for (const SolidFacet& f : a.facets()) {
    for (const SolidFacet& g : b.facets()) {
      if (!same_direction(f.normal, g.normal, monitor)) continue;
      const std::size_t sums = f.pieces.size() * g.pieces.size();
      pairs += sums * (sums - 1) / 2;
    }
  }
  return pairs;
}

std::size_t piece_count(const SolidFeatures& solid) {
  std::size_t count = 0;
  for (const SolidFacet& f : solid.facets()) count += f.pieces.size();
  return count;
}

// True if all facets of both lie along one direction or across it: both are extrusions, or stacks of some, whose cells
// are prisms that share planes exactly.
bool are_extruded(const SolidFeatures& a, const SolidFeatures& b, const Monitor& monitor) {
  const auto pieces = [](const SolidFacet& f, const SolidFacet& g) { return f.pieces.size() < g.pieces.size(); };
  const Direction& along = std::max_element(a.facets().begin(), a.facets().end(), pieces)->normal;
  const Direction back = along.negated();
  const auto fits = [&](const SolidFacet& f) {
    return sign_of_dot(f.normal, along, monitor) == 0 || same_direction(f.normal, along, monitor) ||
           same_direction(f.normal, back, monitor);
  };
  return std::all_of(a.facets().begin(), a.facets().end(), fits) &&
         std::all_of(b.facets().begin(), b.facets().end(), fits);
}

// So many stacked pairs cost what a pair of cells does, on the safe side for both ways. Measured: a stacked pair takes
// 0.5 microseconds, a pair of cells of extrusions 0.1 ms, and one of turned parts, whose cells nearly coincide, 1 ms.
constexpr std::size_t kStackedPairsOfPrisms = 16;
constexpr std::size_t kStackedPairsOfCells = 160;
// With fewer stacked pairs than this for each piece of a facet, cells are not worth an estimate.
constexpr std::size_t kFewStackedPairs = 8;

struct Costs {
  bool prefers_cells = false;
  std::string why;
};

Costs compare_costs(const Polyhedron& a, const Polyhedron& b, const SolidFeatures& of_a, const SolidFeatures& of_b,
                    const Monitor& monitor) {
  const std::size_t stacked = stacked_pairs(of_a, of_b, monitor);
  std::string why = "about " + plural(stacked, "pair") + " of convolution facets in one plane";
  if (stacked <= kFewStackedPairs * (piece_count(of_a) + piece_count(of_b))) return {false, std::move(why)};
  const std::size_t cells = estimated_cells(a.complex(), monitor) * estimated_cells(b.complex(), monitor);
  why += ", about " + plural(cells, "pair") + " of cells";
  const std::size_t worth = are_extruded(of_a, of_b, monitor) ? kStackedPairsOfPrisms : kStackedPairsOfCells;
  return {stacked / worth > cells, why + " worth " + std::to_string(worth) + " of these each"};
}

}  // namespace

std::optional<Polyhedron> convolution_sum(const Polyhedron& set_a, const Polyhedron& set_b,
                                          const ConvolutionOptions& options, ConvolutionReport& report) {
  const Monitor& monitor = options.monitor;
  const auto decline = [&report](std::string why) {
    report.why = std::move(why);
    return std::nullopt;
  };
  if (options.only_if_fast && is_convex(set_a, monitor) && is_convex(set_b, monitor))
    return decline("both operands are convex");
  const Polyhedron a = filled(set_a, monitor);
  const Polyhedron b = filled(set_b, monitor);
  const SolidFeatures of_a(a, monitor);
  const SolidFeatures of_b(b, monitor);
  Costs costs;
  if (options.only_if_fast) {
    costs = compare_costs(a, b, of_a, of_b, monitor);
    if (costs.prefers_cells) return decline(std::move(costs.why));
  }
  ConvolutionFacets facets = reduced_convolution(of_a, of_b, options.threads, monitor);
  if (!facets.marks_are_told) return decline("a facet that is not in its set has a border that is");
  const SumMembership membership(a, b, monitor);
  const bool is_closed = facets.marks == BoundaryMarks::kAll;
  std::vector<SaddlePoint> saddles;
  if (!is_closed && !(of_a.has_plain_facets() && of_b.has_plain_facets())) {
    return decline("a single point in a facet is marked unlike it");
  }
  if (!is_closed && !is_convex(closure(a, monitor), monitor) && !is_convex(closure(b, monitor), monitor)) {
    if (!of_a.has_simple_edges() || !of_b.has_simple_edges()) {
      return decline("an edge has several wedges, neither operand is convex, and one is not closed");
    }
    saddles = saddle_points(a, b, membership, monitor);
  }
  const auto poll = [&options](double share) {
    if (options.poll) options.poll(share);
  };
  // Shares of the time are measured, for the bar only.
  constexpr double kOfIntervals = 0.2;
  const RoundedFacets rounded(facets);
  if (!rounded.are_proven()) return decline("coordinates are too large or too small for doubles");
  IntervalOptions how;
  how.passages = !is_closed;
  how.threads = options.threads;
  how.monitor = monitor;
  how.poll = [&poll](double share) { poll(kOfIntervals * share); };
  const SurvivingIntervals intervals = surviving_intervals(facets, rounded, how);
  SumOfRegions made = sum_of_regions(facets, rounded, intervals, membership, saddles, options.threads, monitor,
                                     [&poll](double share) { poll(kOfIntervals + (1 - kOfIntervals) * share); });
  // Synthesis checks what it is given, but not all that wrong marks on the boundary would lead to: a facet whose border
  // turns the wrong way.
  if (!is_closed) {
    const std::string broken = validate(made.sum, monitor);
    if (!broken.empty()) {
      throw detail::BrokenInvariant({Defect::Kind::kStructure, "a sum by convolution is a set: " + broken, {}});
    }
  }
  report = {costs.why, facets.size(), intervals.segments.size(), intervals.intervals.size(), made.points, made.tested};
  return Polyhedron(std::move(made.sum));
}

}  // namespace nef::minkowski
