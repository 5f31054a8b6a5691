// SPDX-License-Identifier: Apache-2.0
//
// A cell of an unbounded set is spanned by points and rays, and both can be read off the infimaximal box that cuts it:
// a vertex p + q R of the cell on the box gives the ray q, and all these rays span all directions in which the cell is
// unbounded. Its points come from its minimal faces: finite vertices, lines, whole planes, or all of space.
#include "apps/minkowski/sum/unbounded_sum.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/decomposition/reflex.h"
#include "apps/minkowski/decomposition/walls.h"
#include "apps/minkowski/part_of_sum.h"
#include "nef/base/error.h"
#include "nef/base/timing/phase_timer.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
namespace {

bool is_selected(LabelId label) { return (label & kSelected) != 0 && label != kOutside; }

// Planes that divide every reflex edge and corner; each as the four coefficients of its form.
std::set<std::array<Rational, 4>> dividing_planes(const Complex& c, const Monitor& monitor) {
  std::set<std::array<Rational, 4>> result;
  const auto coefficients = [&](PlaneId plane) {
    std::array<Rational, 4> n;
    for (std::size_t i = 0; i < 4; ++i) n[i] = Rational(c.planes.oriented_coefficient(PlaneId(plane.row() * 2U), i));
    return n;
  };
  for (const ReflexEdge& edge : reflex_edges(c, 2, monitor)) result.insert(coefficients(c.svertex(edge.halfedge).p));
  for (const VertexId v : lonely_vertices(c)) result.insert({1, 0, 0, Rational(-c.points.rational(point_of(v))[0])});
  for (const FacetId f : c.facets.ids()) {
    if (!is_selected(c.facets[f].mark) || c.planes.infimaximal(c.facets[f].plane)) continue;
    for (const ReflexCorner& corner : reflex_corners(c, f, monitor)) {
      const std::array<Rational, 4> own = coefficients(c.facets[f].plane);
      const Integer3 g = cut_direction(c, c.facets[f].plane).integers();
      std::array<Rational, 4> n;
      const Rational3 p = c.points.rational(point_of(corner.vertex));
      for (std::size_t i = 0; i < 3; ++i) {
        n[i] = own[(i + 1) % 3] * g[(i + 2) % 3] - own[(i + 2) % 3] * g[(i + 1) % 3];
        n[3] -= n[i] * p[i];
      }
      result.insert(n);
    }
  }
  return result;
}

// Cuts the set by whole planes until every item is convex.
Polyhedron cut_into_convex_items(const Polyhedron& a, const Monitor& monitor) {
  constexpr std::size_t kMost = 48;
  Polyhedron result = a;
  for (std::size_t total = 0;;) {
    const std::set<std::array<Rational, 4>> planes = dividing_planes(result.complex(), monitor);
    if (planes.empty()) return result;
    total += planes.size();
    if (total > kMost) {
      throw UnsupportedError("an operand of an unbounded sum has too many reflex edges (more than " +
                             std::to_string(kMost) + " planes would cut it): intersect the operands with a box first");
    }
    std::vector<Polyhedron> walls;
    for (const std::array<Rational, 4>& n : planes) {
      walls.push_back(boundary(make_halfspace(n[0], n[1], n[2], n[3], true, monitor), monitor));
    }
    const auto with_wall = [](LabelId own, LabelId wall) -> LabelId {
      return is_selected(own) && wall != 0 ? static_cast<LabelId>(own | kWall) : own;
    };
    result = overlay(result, unite_all(walls, monitor), with_wall, monitor);
  }
}

// Reads the spanning points and rays of the items of a complex whose items are convex.
class SpanReader {
 public:
  explicit SpanReader(const Complex& complex)
      : c_(complex), on_box_(complex.svertex_count(), false), facets_of_volume_(complex.volume_count()) {
    for (const FacetId f : c_.facets.ids()) {
      const Facet& facet = c_.facets[f];
      facets_of_volume_[facet.volume_above].push_back(f);
      if (facet.volume_below != facet.volume_above) facets_of_volume_[facet.volume_below].push_back(f);
      if (!c_.planes.infimaximal(facet.plane)) continue;
      for (const SHalfedgeId corner : c_.corners_of(facet)) on_box_[edge(c_.corner_halfedge(corner))] = true;
    }
  }

  std::vector<SpannedSet> volumes() {
    std::vector<SpannedSet> result;
    for (const VolumeId v : c_.volumes.ids()) {
      if (!is_selected(c_.volumes[v].mark)) continue;
      begin();
      bool any = false;
      for (const FacetId f : facets_of_volume_[v]) {
        add_facet(f);
        any = any || !c_.planes.infimaximal(c_.facets[f].plane);
      }
      if (!any) points_.insert(Rational3{});  // all of space
      result.push_back(end());
    }
    return result;
  }

  // Facets, edges and vertices.
  std::vector<SpannedSet> others() {
    std::vector<SpannedSet> result;
    for (const FacetId f : c_.facets.ids()) {
      if (!is_selected(c_.facets[f].mark) || c_.planes.infimaximal(c_.facets[f].plane)) continue;
      begin();
      add_facet(f);
      result.push_back(end());
    }
    for (const HalfedgeId h : c_.halfedge_ids()) {
      if (edge(h) != h || on_box_[h] || !is_selected(c_.svertex(h).mark)) continue;
      begin();
      add_edge(h);
      result.push_back(end());
    }
    for (const VertexId v : c_.vertex_ids()) {
      if (!is_selected(c_.mark(v)) || !c_.points.finite(point_of(v))) continue;
      begin();
      add_vertex(v);
      result.push_back(end());
    }
    return result;
  }

 private:
  [[nodiscard]] HalfedgeId edge(HalfedgeId h) const { return c_.edge(h); }

  // Coordinates of a vertex: the constant part (first = 0) or the factor of R (first = 4).
  [[nodiscard]] Rational3 part(VertexId v, std::size_t first) const {
    Rational3 result;
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_set(result[i].get_num_mpz_t(), c_.points.coordinate(point_of(v), first + i));
      mpz_set(result[i].get_den_mpz_t(), c_.points.coordinate(point_of(v), 3));
      result[i].canonicalize();
    }
    return result;
  }

  void begin() {
    points_.clear();
    rays_.clear();
  }
  SpannedSet end() const { return {{points_.begin(), points_.end()}, {rays_.begin(), rays_.end()}}; }

  void add_vertex(VertexId v) {
    if (c_.points.finite(point_of(v))) {
      points_.insert(part(v, 0));
    } else {
      rays_.insert(part(v, 4));
    }
  }

  void add_edge(HalfedgeId h) {
    const VertexId from = c_.source(h);
    const VertexId to = c_.target(h);
    add_vertex(from);
    add_vertex(to);
    // A line: the constant part of either end lies on it.
    if (!c_.points.finite(point_of(from)) && !c_.points.finite(point_of(to))) points_.insert(part(from, 0));
  }

  void add_facet(FacetId f) {
    const Facet& facet = c_.facets[f];
    bool bounded_by_edges = false;
    for (const SHalfedgeId corner : c_.corners_of(facet)) {
      const HalfedgeId h = edge(c_.corner_halfedge(corner));
      add_vertex(c_.shalfedge_vertex(corner));
      if (on_box_[h]) continue;
      bounded_by_edges = true;
      add_edge(h);
    }
    for (const VertexId v : c_.isolated_vertices_of(facet)) add_vertex(v);
    if (c_.planes.infimaximal(facet.plane) || bounded_by_edges) return;
    // A whole plane: the constant part of any corner lies on it.
    points_.insert(part(c_.shalfedge_vertex(c_.corners_of(facet)[0]), 0));
  }

  const Complex& c_;
  IndexedVector<HalfedgeId, bool> on_box_;  // per edge (its smaller halfedge): in a wall of the box
  IndexedVector<VolumeId, std::vector<FacetId>> facets_of_volume_;
  std::set<Rational3> points_, rays_;
};

// Which cells are to be summed, and with which boundary; see minkowski_sum.cpp for why that is enough.
enum class Parts : std::uint8_t { kClosedSolids, kOpenSolids, kAll };

std::vector<SpannedSet> cells_of(const Polyhedron& a, Parts parts, const Monitor& monitor) {
  const Polyhedron cut = cut_into_convex_items(a, monitor);
  SpanReader reader(cut.complex());
  std::vector<SpannedSet> cells = reader.volumes();
  if (parts != Parts::kAll) return cells;
  std::vector<SpannedSet> others = reader.others();
  std::move(others.begin(), others.end(), std::back_inserter(cells));
  return cells;
}

}  // namespace

// Cut by a box of any large size, the set has the hull of its vertices; those that move with the box do so on edges of
// the set or of the box, whose other ends or whose lines are spanned, too.
SpannedSet hull_span(const Polyhedron& a) {
  SpanReader reader(a.complex());
  std::set<Rational3> points;
  std::set<Rational3> rays;
  const auto add = [&](const std::vector<SpannedSet>& items) {
    for (const SpannedSet& item : items) {
      points.insert(item.points.begin(), item.points.end());
      rays.insert(item.rays.begin(), item.rays.end());
    }
  };
  add(reader.volumes());
  add(reader.others());
  return {{points.begin(), points.end()}, {rays.begin(), rays.end()}};
}

Polyhedron unbounded_sum(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                         MinkowskiReport& report) {
  Parts parts = Parts::kAll;
  if (is_full_dimensional(a) && is_full_dimensional(b)) {
    if (a.is_closed() && b.is_closed()) parts = Parts::kClosedSolids;
    if (a.is_open() || b.is_open()) parts = Parts::kOpenSolids;
  }
  std::vector<SpannedSet> cells_a;
  std::vector<SpannedSet> cells_b;
  {
    const PhaseTimer phase(report.seconds_decomposition, report.predicates_decomposition, options.monitor);
    cells_a = cells_of(a, parts, phase.monitor());
    cells_b = cells_of(b, parts, phase.monitor());
  }
  report.cells_a += cells_a.size();
  report.cells_b += cells_b.size();
  const std::size_t pairs = cells_a.size() * cells_b.size();
  constexpr std::size_t kMostPairs = 20000;
  if (pairs > kMostPairs) {
    throw UnsupportedError("an unbounded sum of " + std::to_string(cells_a.size()) + " and " +
                           std::to_string(cells_b.size()) +
                           " cells is too large: intersect the operands with a box first");
  }
  report.pairs += pairs;
  std::vector<Polyhedron> sums(pairs);
  const PartOfSum whole(options.monitor);
  std::size_t done = 0;
  {
    const PhaseTimer phase(report.seconds_convex_sums, report.predicates_convex_sums, options.monitor);
    for (const SpannedSet& c : cells_a) {
      for (const SpannedSet& d : cells_b) {
        sums[done++] = to_polyhedron(sum_of(c, d), parts == Parts::kClosedSolids, phase.monitor());
        whole.monitor().tell_progress(kSumPhase, done, 2 * pairs);
      }
    }
  }
  const PhaseTimer phase(report.seconds_union, report.predicates_union, options.monitor);
  Polyhedron result = unite_all(sums, phase.monitor());
  whole.monitor().tell_progress(kSumPhase, 1, 1);
  return result;
}

}  // namespace nef::minkowski
