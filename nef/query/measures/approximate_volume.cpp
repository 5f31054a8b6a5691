// SPDX-License-Identifier: Apache-2.0
//
// The integrals of measure.cpp and moments.cpp in interval arithmetic, so that the bounds need no proof beyond that of
// Interval. Coordinates are within 2^-51 of themselves of the truth (PointTable::approximate). All points are taken
// relative to a vertex of the set, and those of a facet relative to one of its corners, so that products are as small
// as the set and the facet, and little is lost by cancellation: a volume is off by about 2^-50 of the products of the
// coordinates with the area, for each thousand facets by a few units more.
#include "nef/query/measures/approximate_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "nef/base/threads/parallel.h"
#include "nef/complex/predicates_of_sets.h"
#include "nef/geometry/vectors.h"
#include "nef/number/interval.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

using Interval3 = std::array<Interval, 3>;

Interval3 enclosure(const Double3& p) {
  Interval3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = Interval::around(p[i], std::fabs(p[i]) * 0x1p-51);
  return result;
}

Interval3 enclosure(const Complex& c, VertexId v) { return enclosure(c.points.approximate(point_of(v))); }

bool has_infinite_volume(const Complex& c) {
  if (is_selected(c.volumes[kOuterVolume].mark)) return true;
  for (const FacetId f : c.facets.ids()) {
    if (!is_box_facet(c, f)) continue;
    const Facet facet = c.facets[f];
    if (is_selected(c.volumes[facet.volume_above].mark) || is_selected(c.volumes[facet.volume_below].mark)) return true;
  }
  return false;
}

// +1 if the set lies below a facet only, -1 if above only, 0 if the facet bounds no finite part of it.
int side_of_set(const Complex& c, FacetId f, const Facet& facet) {
  const bool above = is_selected(c.volumes[facet.volume_above].mark);
  const bool below = is_selected(c.volumes[facet.volume_below].mark);
  if (above == below || is_box_facet(c, f) || !has_finite_corners(c, facet)) return 0;
  return below ? 1 : -1;
}

// Twice the area vector, about a corner. Cycles run counterclockwise as seen from above, so it points upward.
Interval3 twice_area(const Complex& c, const Facet& facet, const Interval3& corner0) {
  Interval3 area;
  for (const SHalfedgeId corner : c.corners_of(facet)) {
    const Interval3 p = minus(enclosure(c, c.shalfedge_vertex(corner)), corner0);
    const Interval3 q = minus(enclosure(c, c.target(c.corner_halfedge(corner))), corner0);
    const Interval3 product = cross(p, q);
    for (std::size_t i = 0; i < 3; ++i) area[i] += product[i];
  }
  return area;
}

Interval3 first_corner(const Complex& c, const Facet& facet) {
  return enclosure(c, c.shalfedge_vertex(c.corners_of(facet.first_cycle).front()));
}

constexpr std::size_t kFacets = 4096;  // of a task

// The sum of of_facet(f) over all facets, some thousands at a time: it does not depend on the threads.
template <typename OfFacet>
Interval summed(const Complex& c, const Monitor& monitor, const OfFacet& of_facet) {
  const std::size_t facets = c.facets.size();
  std::vector<Interval> sums((facets + kFacets - 1) / kFacets);
  parallel_for(sums.size(), monitor, [&](std::size_t task, const Monitor&) {
    const std::size_t first = task * kFacets;
    for (const FacetId f : IdRange(FacetId{first}, FacetId{std::min(first + kFacets, facets)})) {
      sums[task] += of_facet(f);
    }
  });
  Interval all;
  for (const Interval& some : sums) all += some;
  return all;
}

// Some finite vertex, as the doubles that stand for it; these are a point by themselves, without error.
Double3 some_point(const Complex& c) {
  for (const VertexId v : c.vertex_ids()) {
    if (!is_box_vertex(c, v)) return c.points.approximate(point_of(v));
  }
  return {};
}

Interval3 exactly(const Double3& p) { return {p[0], p[1], p[2]}; }

}  // namespace

MeasuredVolume approximate_volume(const Polyhedron& a, const Monitor& monitor) {
  return approximate_volume(a.complex(), monitor);
}

MeasuredVolume approximate_volume(const Complex& c, const Monitor& monitor) {
  if (has_infinite_volume(c)) return {HUGE_VAL, 0};
  const Interval3 origin = exactly(some_point(c));
  const Interval six_volumes = summed(c, monitor, [&](FacetId f) {
    const Facet facet = c.facets[f];
    const int side = side_of_set(c, f, facet);
    if (side == 0) return Interval();
    const Interval3 corner0 = first_corner(c, facet);
    return Interval(side) * dot(minus(corner0, origin), twice_area(c, facet, corner0));
  });
  const Interval result = six_volumes / Interval(6);
  return {result.middle(), result.radius()};
}

MeasuredArea approximate_area(const Polyhedron& a, const Monitor& monitor) {
  const Complex& c = a.complex();
  for (const FacetId f : c.facets.ids()) {
    if (!is_box_facet(c, f) && !has_finite_corners(c, c.facets[f])) return {HUGE_VAL, 0};
  }
  const Interval twice = summed(c, monitor, [&](FacetId f) {
    if (is_box_facet(c, f)) return Interval();
    const Facet facet = c.facets[f];
    const Interval3 area = twice_area(c, facet, first_corner(c, facet));
    return sqrt(dot(area, area));
  });
  const Interval result = twice / Interval(2);
  return {result.middle(), result.radius()};
}

namespace {

// As MomentSums of moments.cpp, about an origin in the set: tetrahedra with their signs.
struct MomentEnclosures {
  Interval volume;                  // times 6
  Interval3 first;                  // times 24
  std::array<Interval3, 3> second;  // times 120, j >= i

  void add(const Interval3& u, const Interval3& v, const Interval3& w, int sign) {
    const Interval six_volumes = Interval(sign) * dot(u, cross(v, w));
    volume += six_volumes;
    Interval3 sum;
    for (std::size_t i = 0; i < 3; ++i) sum[i] = u[i] + v[i] + w[i];
    for (std::size_t i = 0; i < 3; ++i) {
      first[i] += six_volumes * sum[i];
      for (std::size_t j = i; j < 3; ++j) {
        second[i][j] += six_volumes * (sum[i] * sum[j] + u[i] * u[j] + v[i] * v[j] + w[i] * w[j]);
      }
    }
  }
};

MomentEnclosures moments_about(const Complex& c, const Interval3& origin, const Monitor& monitor) {
  MomentEnclosures sums;
  for (const FacetId f : c.facets.ids()) {
    if (f.index() % kFacets == 0) monitor.check_interruption();
    const Facet facet = c.facets[f];
    const int side = side_of_set(c, f, facet);
    if (side == 0) continue;
    const std::span<const SHalfedgeId> corners = c.corners_of(facet);
    const VertexId apex = c.shalfedge_vertex(corners.front());
    const Interval3 at_apex = minus(enclosure(c, apex), origin);
    for (const SHalfedgeId corner : corners) {
      const VertexId u = c.shalfedge_vertex(corner);
      const VertexId v = c.target(c.corner_halfedge(corner));
      if (u == apex || v == apex) continue;
      sums.add(at_apex, minus(enclosure(c, u), origin), minus(enclosure(c, v), origin), side);
    }
  }
  return sums;
}

}  // namespace

std::optional<MeasuredMoments> approximate_moments(const Polyhedron& a, const Monitor& monitor) {
  const Complex& c = a.complex();
  if (has_infinite_volume(c)) return std::nullopt;
  const Double3 origin = some_point(c);
  const MomentEnclosures sums = moments_about(c, exactly(origin), monitor);
  const Interval volume = sums.volume / Interval(6);
  if (volume.low() <= 0) return std::nullopt;
  MeasuredMoments result;
  Interval3 centre;
  for (std::size_t i = 0; i < 3; ++i) {
    centre[i] = sums.first[i] / Interval(24) / volume;
    const Interval at = Interval(origin[i]) + centre[i];
    result.centroid[i] = at.middle();
    result.centroid_error = std::max(result.centroid_error, at.radius());
  }
  // The second moments about the centre: those about the origin less volume times the products of its coordinates.
  std::array<Interval3, 3> centred;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      centred[i][j] = centred[j][i] = sums.second[i][j] / Interval(120) - sums.first[i] / Interval(24) * centre[j];
    }
  }
  const Interval trace = centred[0][0] + centred[1][1] + centred[2][2];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Interval entry = i == j ? trace - centred[i][j] : -centred[i][j];
      result.inertia[i][j] = entry.middle();
      result.inertia_error = std::max(result.inertia_error, entry.radius());
    }
  }
  result.principal = principal_inertia(result.inertia);
  return result;
}

}  // namespace nef
