// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/convolution_sum.h"

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "apps/minkowski/convolution/convolution_regions.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/decomposition/wall_axis.h"
#include "apps/minkowski/minkowski.h"

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

// How many pairs of facets lie in one plane.
std::size_t coplanar_pairs(const ConvolutionFacets& facets) {
  std::vector<std::size_t> count(facets.planes.size(), 0);
  std::size_t pairs = 0;
  for (const PlaneId plane : facets.plane) pairs += count[plane.row()]++;
  return pairs;
}

// Measured: stars and gears have 40 to 180 pairs a facet and 90 to 430 for each pair of cells, a mushroom with itself
// 13 and 5, meshes with few parallel facets about one a facet.
constexpr std::size_t kCoplanarPairs = 8;
constexpr std::size_t kCoplanarPairsOfCells = 16;

std::string plural(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// Whether so many facets lie in one plane upon each other that cells are likely to be faster.
struct Stacking {
  bool is_high = false;
  std::string why;
};

Stacking stacking(const ConvolutionFacets& facets, const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  const std::size_t pairs = coplanar_pairs(facets);
  std::string why = plural(pairs, "pair") + " of " + plural(facets.size(), "convolution facet") + " in one plane";
  if (pairs <= kCoplanarPairs * facets.size()) return {false, std::move(why)};
  const std::size_t cells = estimated_cells(a.complex(), monitor) * estimated_cells(b.complex(), monitor);
  return {pairs > kCoplanarPairsOfCells * cells, why + ", about " + plural(cells, "pair") + " of cells"};
}

// So many sums of pieces of two parallel facets tell that before anything is summed.
constexpr std::size_t kParallelPieces = 100;

bool are_caps(const SolidFeatures& a, const SolidFeatures& b, const Monitor& monitor) {
  for (const SolidFacet& f : a.facets()) {
    for (const SolidFacet& g : b.facets()) {
      if (f.pieces.size() * g.pieces.size() > kParallelPieces && same_direction(f.normal, g.normal, monitor))
        return true;
    }
  }
  return false;
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
  if (options.only_if_fast && are_caps(of_a, of_b, monitor)) return decline("parallel facets of many pieces");
  ConvolutionFacets facets = reduced_convolution(of_a, of_b, options.threads, monitor);
  if (!facets.marks_are_told) return decline("a facet that is not in its set has a border that is");
  Stacking stacked;
  if (options.only_if_fast) {
    stacked = stacking(facets, a, b, monitor);
    if (stacked.is_high) return decline(std::move(stacked.why));
  }
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
  IntervalOptions how;
  how.passages = !is_closed;
  how.threads = options.threads;
  how.monitor = monitor;
  how.poll = [&poll](double share) { poll(kOfIntervals * share); };
  const SurvivingIntervals intervals = surviving_intervals(facets, rounded, how);
  SumOfRegions made = sum_of_regions(facets, rounded, intervals, membership, saddles, options.threads, monitor,
                                     [&poll](double share) { poll(kOfIntervals + (1 - kOfIntervals) * share); });
  // Synthesis checks what it is given, but not all that wrong marks on the boundary would lead to: a facet whose border
  // turns the wrong way. Should there be a bug, the cells are there, and the tests see that they were needed.
  const auto* sum = std::get_if<Complex>(&made.sum);
  report.has_defect = sum == nullptr || (!is_closed && !validate(*sum, monitor).empty());
  if (report.has_defect) return decline("the convolution had a defect: please report it");
  report = {stacked.why, false,      facets.size(), intervals.segments.size(), intervals.intervals.size(),
            made.points, made.tested};
  return Polyhedron(std::get<Complex>(std::move(made.sum)));
}

}  // namespace nef::minkowski
