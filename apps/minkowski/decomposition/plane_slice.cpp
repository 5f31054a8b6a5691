// SPDX-License-Identifier: Apache-2.0
//
// The sign of each vertex against the plane is computed once per slice. A facet with vertices on both sides is cut at
// those of its edges that cross the plane; the points are sorted along the line of intersection. A convex facet gives
// one segment between the first and the last; otherwise the middle of each gap is tested by the parity of crossings of
// a ray. Coordinates are exact. Heights of segments are compared in doubles with a bound on their error, and exactly
// where these do not decide.
#include "apps/minkowski/decomposition/plane_slice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/minkowski/decomposition/reflex.h"
#include "nef/complex/item_boxes.h"

namespace nef::minkowski {
namespace {

// A height in doubles, with a bound of its error. All inputs are within 4 units of roundoff (2^-53), and within 2^-1074
// if they are below 2^-1022, which the last terms cover.
struct Estimate {
  double value = 0;
  double error = 0;
};
Estimate estimate(const std::array<double, 2>& u, const std::array<double, 2>& h, double at) {
  const double span = u[1] - u[0];
  const double share = (at - u[0]) / span;
  const double rise = h[1] - h[0];
  const double largest = std::max({std::fabs(u[0]), std::fabs(u[1]), std::fabs(at)});
  const double height = std::max(std::fabs(h[0]), std::fabs(h[1]));
  constexpr double kUnit = 0x1p-53;
  // Both differences of u are off by at most 9u * largest each, and share is at most 1.
  const double share_error = 18 * kUnit * largest / span + 4 * kUnit;
  Estimate result;
  result.value = h[0] + rise * share;
  result.error = 2 * (std::fabs(rise) * share_error + 24 * kUnit * height) + 1e-290;
  if (!(span > 32 * kUnit * largest + 1e-250)) result.error = std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace

Rational3 SliceFrame::lift(const std::array<Rational, 2>& p) const {
  Rational3 x;
  x[u] = p[0];
  x[h] = p[1];
  x[w()] = origin[w()] + slope * (p[0] - origin[u]);
  return x;
}

Rational SliceFrame::form(const Rational3& p) const { return p[w()] - origin[w()] - slope * (p[u] - origin[u]); }

SliceSegment make_slice_segment(const std::array<Rational, 2>& left, const std::array<Rational, 2>& right) {
  SliceSegment s{{left[0], right[0]}, {left[1], right[1]}, {}, {}};
  for (std::size_t k = 0; k < 2; ++k) {
    s.du[k] = nearest_double(s.u[k]);
    s.dh[k] = nearest_double(s.h[k]);
  }
  return s;
}

int compare_heights(const SliceSegment& a, const SliceSegment& b, const Rational& at, double at_double) {
  const Estimate x = estimate(a.du, a.dh, at_double);
  const Estimate y = estimate(b.du, b.dh, at_double);
  if (std::fabs(x.value - y.value) > 1.01 * (x.error + y.error)) return x.value > y.value ? 1 : -1;
  const int order = cmp(a.height(at), b.height(at));
  return (order > 0) - (order < 0);
}

PlaneSlicer::PlaneSlicer(const Complex& complex, const Monitor& monitor)
    : complex_(complex),
      monitor_(monitor),
      convex_(complex.facet_count(), -1),
      points_(complex.vertex_count()),
      known_(complex.vertex_count(), 0),
      side_slice_(complex.vertex_count(), 0),
      side_(complex.vertex_count(), 0) {
  for (const Facet& f : complex.facets) facet_boxes_.push_back(nef::facet_box(complex, f));
  facets_ = BoxTree(facet_boxes_);
  for (const HalfedgeId h : complex.halfedge_ids()) {
    if (h < complex.twin[h] && complex.svertex(h).out == kNone) isolated_edges_.push_back(h);
  }
}

const Rational3& PlaneSlicer::point(VertexId vertex) {
  if (known_[vertex] == 0) {
    points_[vertex] = complex_.points.rational(point_of(vertex));
    known_[vertex] = 1;
  }
  return points_[vertex];
}

bool PlaneSlicer::convex(FacetId facet) {
  if (convex_[facet] < 0) {
    const Facet& f = complex_.facets[facet];
    const bool triangle = f.cycle_count == 1 && f.isolated_count == 0 && complex_.corners_of(f).size() == 3;
    convex_[facet] = triangle || reflex_corners(complex_, facet, monitor_).empty() ? 1 : 0;
  }
  return convex_[facet] != 0;
}

void PlaneSlicer::begin(const SliceFrame& frame) {
  frame_ = frame;
  ++slice_;
  segments_.clear();
  uprights_.clear();
  Rational3 normal;
  normal[frame.w()] = 1;
  normal[frame.u] = -frame.slope;
  plane_ = planes_.intern(normal, Rational(frame.slope * frame.origin[frame.u] - frame.origin[frame.w()]));
}

int PlaneSlicer::side(VertexId vertex) {
  if (side_slice_[vertex] != slice_) {
    side_slice_[vertex] = slice_;
    side_[vertex] =
        static_cast<std::int8_t>(side_of_plane(planes_, plane_, complex_.points, point_of(vertex), monitor_));
  }
  return side_[vertex];
}

std::array<Rational, 2> PlaneSlicer::flat(VertexId vertex) {
  return {point(vertex)[frame_.u], point(vertex)[frame_.h]};
}

void PlaneSlicer::add_segment(const std::array<Rational, 2>& p, const std::array<Rational, 2>& q) {
  const int order = cmp(p[0], q[0]);
  if (order != 0) {
    segments_.push_back(order < 0 ? make_slice_segment(p, q) : make_slice_segment(q, p));
  } else if (p[1] != q[1]) {
    uprights_.push_back({p[0], std::min(p[1], q[1]), std::max(p[1], q[1])});
  }
}

// Where the edge ab, whose ends are on different sides, meets the plane.
std::array<Rational, 2> PlaneSlicer::crossing(VertexId a, VertexId b) {
  const Rational3& p = point(a);
  const Rational3& q = point(b);
  const Rational fp = frame_.form(p);
  const Rational t = fp / (fp - frame_.form(q));
  return {Rational(p[frame_.u] + t * (q[frame_.u] - p[frame_.u])),
          Rational(p[frame_.h] + t * (q[frame_.h] - p[frame_.h]))};
}

// Point in polygon by the parity of crossings with a ray along one coordinate, for a point of the
// facet's plane and of the slice that is not on the facet's boundary.
bool PlaneSlicer::holds(FacetId facet, const std::array<Rational, 2>& p) {
  const Rational3 x = frame_.lift(p);
  const Facet& f = complex_.facets[facet];
  std::size_t drop = 0;
  while (complex_.planes.coefficient(f.plane, drop).sign() == 0) ++drop;
  const std::size_t i = (drop + 1) % 3;
  const std::size_t j = (drop + 2) % 3;
  bool inside = false;
  for (const SHalfedgeId c : complex_.corners_of(f)) {
    const Rational3& a = point(complex_.shalfedge_vertex(c));
    const Rational3& b = point(complex_.target(complex_.corner_halfedge(c)));
    if ((a[i] > x[i]) == (b[i] > x[i])) continue;
    if (a[j] + (b[j] - a[j]) * (x[i] - a[i]) / (b[i] - a[i]) > x[j]) inside = !inside;
  }
  return inside;
}

void PlaneSlicer::add_facet(FacetId facet) {
  const Facet& f = complex_.facets[facet];
  const auto corners = complex_.corners_of(f);
  bool off = false;
  bool positive = false;
  bool negative = false;
  for (const SHalfedgeId c : corners) {
    const int s = side(complex_.shalfedge_vertex(c));
    off = off || s != 0;
    positive = positive || s >= 0;
    negative = negative || s <= 0;
  }
  if (!(positive && negative)) return;

  std::vector<std::array<Rational, 2>> hits;
  for (const SHalfedgeId c : corners) {
    const VertexId a = complex_.shalfedge_vertex(c);
    const VertexId b = complex_.target(complex_.corner_halfedge(c));
    const int sa = side(a);
    const int sb = side(b);
    if (sa == 0) hits.push_back(flat(a));
    if (sa == 0 && sb == 0) {
      add_segment(flat(a), flat(b));
    } else if (sa * sb < 0) {
      hits.push_back(crossing(a, b));
    }
  }
  if (!off) return;  // the facet lies in the plane: its edges are the cut
  std::sort(hits.begin(), hits.end());
  hits.erase(std::unique(hits.begin(), hits.end()), hits.end());
  if (hits.size() < 2) return;
  if (convex(facet)) {
    add_segment(hits.front(), hits.back());
    return;
  }
  for (std::size_t k = 0; k + 1 < hits.size(); ++k) {
    const std::array<Rational, 2> middle = {Rational((hits[k][0] + hits[k + 1][0]) / 2),
                                            Rational((hits[k][1] + hits[k + 1][1]) / 2)};
    if (holds(facet, middle)) add_segment(hits[k], hits[k + 1]);
  }
}

void PlaneSlicer::add_isolated_edge(HalfedgeId halfedge) {
  const VertexId a = complex_.source(halfedge);
  const VertexId b = complex_.target(halfedge);
  if (side(a) == 0 && side(b) == 0) add_segment(flat(a), flat(b));
}

void PlaneSlicer::add_overlapping(const Box& query) {
  facets_.for_each_overlap(query, [&](std::uint32_t f) { add_facet(FacetId{f}); });
  for (const HalfedgeId h : isolated_edges_) add_isolated_edge(h);
}

}  // namespace nef::minkowski
