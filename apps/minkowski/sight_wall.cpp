// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/sight_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nef/base/error.h"

namespace nef::minkowski {
namespace {

// Where the line through two points of the (u, h) plane is at u.
Rational height_at(const std::array<Rational, 2>& u, const std::array<Rational, 2>& h, const Rational& at) {
  return h[0] + (h[1] - h[0]) * (at - u[0]) / (u[1] - u[0]);
}

// The same in doubles, with a bound of its error. All inputs are within 4 units of roundoff (2^-53).
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
  result.error = 2 * (std::fabs(rise) * share_error + 24 * kUnit * height);
  if (!(span > 32 * kUnit * largest)) result.error = std::numeric_limits<double>::infinity();
  return result;
}

Box box_of(const Complex& complex, const Facet& facet) {
  Box box;
  for (const std::uint32_t c : complex.facet_corners(facet)) {
    box.add_rounded(complex.points.approximate(PointId(complex.shalfedge_owner[c])));
  }
  return box;
}

}  // namespace

WallBuilder::WallBuilder(const Complex& complex)
    : complex_(complex),
      points_(complex.vertex_count()),
      known_(complex.vertex_count(), 0),
      side_wall_(complex.vertex_count(), 0),
      side_of_(complex.vertex_count(), 0) {
  for (std::uint32_t f = 0; f < complex.facet_count(); ++f) {
    facet_boxes_.push_back(box_of(complex, complex.facets[f]));
    const bool triangle = complex.facets[f].cycle_count == 1 && complex.facets[f].isolated_count == 0 &&
                          complex.facet_corners(complex.facets[f]).size() == 3;
    convex_.push_back(triangle || reflex_corners(complex, f).empty() ? 1 : 0);
  }
  facets_ = BoxTree(facet_boxes_);
  for (std::uint32_t h = 0; h < complex.svertices.size(); ++h) {
    if (h < complex.twin[h] && complex.svertices[h].out == kNone) isolated_edges_.push_back(h);
  }
}

const Rational3& WallBuilder::point(std::uint32_t vertex) {
  if (known_[vertex] == 0) {
    points_[vertex] = complex_.points.rational(PointId(vertex));
    known_[vertex] = 1;
  }
  return points_[vertex];
}

int WallBuilder::side(const Base& base, std::uint32_t vertex) {
  if (side_wall_[vertex] != wall_) {
    side_wall_[vertex] = wall_;
    side_of_[vertex] =
        static_cast<std::int8_t>(side_of_plane(wall_planes_, base.plane, complex_.points, PointId(vertex)));
  }
  return side_of_[vertex];
}

WallBuilder::Base WallBuilder::base_of(const Rational3& from, const Rational3& to, std::size_t axis) {
  Base base;
  base.h = axis;
  base.u = (axis + 1) % 3;
  if (from[base.u] == to[base.u]) base.u = (axis + 2) % 3;
  const bool forth = from[base.u] < to[base.u];
  base.from = forth ? from : to;
  base.to = forth ? to : from;
  const std::size_t w = 3 - base.u - base.h;
  // The plane through the edge and parallel to the axis: du (x_w - w0) - dw (x_u - u0) = 0.
  const Rational du = base.to[base.u] - base.from[base.u];
  const Rational dw = base.to[w] - base.from[w];
  Rational3 normal;
  normal[w] = du;
  normal[base.u] = -dw;
  base.plane = wall_planes_.intern(normal, Rational(dw * base.from[base.u] - du * base.from[w]));
  return base;
}

void WallBuilder::add_blocker(const std::array<Rational, 2>& p, const std::array<Rational, 2>& q) {
  const int order = cmp(p[0], q[0]);
  if (order == 0) return;  // stands upright: hides nothing of positive width
  const std::array<Rational, 2>& left = order < 0 ? p : q;
  const std::array<Rational, 2>& right = order < 0 ? q : p;
  Blocker blocker{{left[0], right[0]}, {left[1], right[1]}, {}, {}};
  for (std::size_t k = 0; k < 2; ++k) {
    blocker.du[k] = nearest_double(blocker.u[k]);
    blocker.dh[k] = nearest_double(blocker.h[k]);
  }
  blockers_.push_back(std::move(blocker));
}

// Where the edge ab, whose ends are on different sides, meets the plane.
std::array<Rational, 2> WallBuilder::crossing(const Base& base, std::uint32_t a, std::uint32_t b) {
  const Rational3& p = point(a);
  const Rational3& q = point(b);
  const std::size_t w = 3 - base.u - base.h;
  const Rational du = base.to[base.u] - base.from[base.u];
  const Rational dw = base.to[w] - base.from[w];
  const auto form = [&](const Rational3& x) {
    return Rational(du * (x[w] - base.from[w]) - dw * (x[base.u] - base.from[base.u]));
  };
  const Rational fp = form(p);
  const Rational t = fp / (fp - form(q));
  return {Rational(p[base.u] + t * (q[base.u] - p[base.u])), Rational(p[base.h] + t * (q[base.h] - p[base.h]))};
}

// Point in polygon by the parity of crossings with a ray along one coordinate, for a point of the
// facet's plane and of the wall's that is not on the facet's boundary.
bool WallBuilder::holds(std::uint32_t facet, const Base& base, const std::array<Rational, 2>& p) {
  const std::size_t w = 3 - base.u - base.h;
  Rational3 x;
  x[base.u] = p[0];
  x[base.h] = p[1];
  x[w] =
      base.from[w] + (base.to[w] - base.from[w]) * (p[0] - base.from[base.u]) / (base.to[base.u] - base.from[base.u]);
  const Facet& f = complex_.facets[facet];
  std::size_t drop = 0;
  while (complex_.planes.coefficient(f.plane, drop).sign() == 0) ++drop;
  const std::size_t i = (drop + 1) % 3;
  const std::size_t j = (drop + 2) % 3;
  bool inside = false;
  for (const std::uint32_t c : complex_.facet_corners(f)) {
    const Rational3& a = point(complex_.shalfedge_owner[c]);
    const Rational3& b = point(complex_.target(complex_.corner_halfedge(c)));
    if ((a[i] > x[i]) == (b[i] > x[i])) continue;
    if (height_at({a[i], b[i]}, {a[j], b[j]}, x[i]) > x[j]) inside = !inside;
  }
  return inside;
}

void WallBuilder::collect_facet(const Base& base, std::uint32_t facet) {
  const Facet& f = complex_.facets[facet];
  const auto corners = complex_.facet_corners(f);
  bool off = false;
  bool positive = false;
  bool negative = false;
  for (const std::uint32_t c : corners) {
    const int s = side(base, complex_.shalfedge_owner[c]);
    off = off || s != 0;
    positive = positive || s >= 0;
    negative = negative || s <= 0;
  }
  if (!(positive && negative)) return;

  std::vector<std::array<Rational, 2>> hits;
  for (const std::uint32_t c : corners) {
    const std::uint32_t a = complex_.shalfedge_owner[c];
    const std::uint32_t b = complex_.target(complex_.corner_halfedge(c));
    const int sa = side(base, a);
    const int sb = side(base, b);
    if (sa == 0) hits.push_back({point(a)[base.u], point(a)[base.h]});
    if (sa == 0 && sb == 0) {
      add_blocker({point(a)[base.u], point(a)[base.h]}, {point(b)[base.u], point(b)[base.h]});
    } else if (sa * sb < 0) {
      hits.push_back(crossing(base, a, b));
    }
  }
  if (!off) return;  // the facet lies in the plane of the wall: its edges are the blockers
  std::sort(hits.begin(), hits.end());
  hits.erase(std::unique(hits.begin(), hits.end()), hits.end());
  if (hits.size() < 2 || hits.front()[0] == hits.back()[0]) return;
  if (convex_[facet] != 0) {
    add_blocker(hits.front(), hits.back());
    return;
  }
  for (std::size_t k = 0; k + 1 < hits.size(); ++k) {
    const std::array<Rational, 2> middle = {Rational((hits[k][0] + hits[k + 1][0]) / 2),
                                            Rational((hits[k][1] + hits[k + 1][1]) / 2)};
    if (holds(facet, base, middle)) add_blocker(hits[k], hits[k + 1]);
  }
}

void WallBuilder::collect_isolated_edge(const Base& base, std::uint32_t halfedge) {
  const std::uint32_t a = complex_.svertex_owner[halfedge];
  const std::uint32_t b = complex_.target(halfedge);
  if (side(base, a) != 0 || side(base, b) != 0) return;
  add_blocker({point(a)[base.u], point(a)[base.h]}, {point(b)[base.u], point(b)[base.h]});
}

void WallBuilder::collect(const Base& base, bool upwards) {
  ++wall_;
  blockers_.clear();
  Box query;
  for (const Rational3* p : {&base.from, &base.to}) {
    query.add_rounded({nearest_double((*p)[0]), nearest_double((*p)[1]), nearest_double((*p)[2])});
  }
  (upwards ? query.high : query.low)[base.h] = (upwards ? 1 : -1) * std::numeric_limits<double>::infinity();
  facets_.for_each_overlap(query, [&](std::uint32_t f) { collect_facet(base, f); });
  for (const std::uint32_t h : isolated_edges_) collect_isolated_edge(base, h);
}

std::vector<Rational> WallBuilder::breakpoints(const Base& base) const {
  std::vector<Rational> u = {base.from[base.u], base.to[base.u]};
  for (const Blocker& b : blockers_) {
    for (const Rational& x : b.u) {
      if (x > base.from[base.u] && x < base.to[base.u]) u.push_back(x);
    }
  }
  std::sort(u.begin(), u.end());
  u.erase(std::unique(u.begin(), u.end()), u.end());
  return u;
}

// For each interval between breakpoints the nearest blocker. Blockers do not cross each other, nor
// the base, so the middle of the interval decides.
std::vector<WallBuilder::Run> WallBuilder::visible(const Base& base, const std::vector<Rational>& u,
                                                   bool upwards) const {
  const std::array<Rational, 2> base_u = {base.from[base.u], base.to[base.u]};
  const std::array<Rational, 2> base_h = {base.from[base.h], base.to[base.h]};
  const std::array<double, 2> base_du = {nearest_double(base_u[0]), nearest_double(base_u[1])};
  const std::array<double, 2> base_dh = {nearest_double(base_h[0]), nearest_double(base_h[1])};
  const int way = upwards ? 1 : -1;
  std::vector<Run> runs;
  for (std::uint32_t k = 0; k + 1 < u.size(); ++k) {
    const Rational middle = (u[k] + u[k + 1]) / 2;
    const double at = nearest_double(middle);
    // The sign of (height of b at the middle) - (height of the line c there).
    const auto compare = [&](const Blocker& b, const std::array<Rational, 2>& cu, const std::array<Rational, 2>& ch,
                             const std::array<double, 2>& cdu, const std::array<double, 2>& cdh) {
      const Estimate x = estimate(b.du, b.dh, at);
      const Estimate y = estimate(cdu, cdh, at);
      if (std::fabs(x.value - y.value) > 1.01 * (x.error + y.error)) return x.value > y.value ? 1 : -1;
      return cmp(height_at(b.u, b.h, middle), height_at(cu, ch, middle));
    };
    std::uint32_t nearest = kNone;
    for (std::uint32_t i = 0; i < blockers_.size(); ++i) {
      const Blocker& b = blockers_[i];
      if (!(b.u[0] < middle) || !(middle < b.u[1])) continue;
      if (way * compare(b, base_u, base_h, base_du, base_dh) <= 0) continue;
      if (nearest != kNone) {
        const Blocker& n = blockers_[nearest];
        if (way * compare(b, n.u, n.h, n.du, n.dh) >= 0) continue;
      }
      nearest = i;
    }
    NEF_ASSERT(nearest != kNone);  // the volume is bounded
    if (!runs.empty() && runs.back().blocker == nearest) {
      runs.back().last = k + 1;
    } else {
      runs.push_back({nearest, k, k + 1});
    }
  }
  return runs;
}

void WallBuilder::erect(const Base& base, bool upwards, Mesh& walls) {
  collect(base, upwards);
  const std::vector<Rational> u = breakpoints(base);
  const std::vector<Run> runs = visible(base, u, upwards);

  // Along the edge, then back along what is seen; equal and collinear neighbours are left out.
  std::vector<std::array<Rational, 2>> ring = {{base.from[base.u], base.from[base.h]},
                                               {base.to[base.u], base.to[base.h]}};
  const auto push = [&](const Rational& at, const Rational& height) {
    const std::array<Rational, 2> p = {at, height};
    if (ring.back() == p) return;
    if (ring.size() > 2) {
      const std::array<Rational, 2>& b = ring.back();
      const std::array<Rational, 2>& a = ring[ring.size() - 2];
      if ((b[0] - a[0]) * (p[1] - a[1]) == (b[1] - a[1]) * (p[0] - a[0]) && (a[0] > b[0]) == (b[0] > p[0]) &&
          (a[1] > b[1]) == (b[1] > p[1])) {
        ring.back() = p;
        return;
      }
    }
    ring.push_back(p);
  };
  for (std::size_t k = runs.size(); k-- > 0;) {
    const Blocker& b = blockers_[runs[k].blocker];
    push(u[runs[k].last], height_at(b.u, b.h, u[runs[k].last]));
    push(u[runs[k].first], height_at(b.u, b.h, u[runs[k].first]));
  }
  if (ring.back() == ring.front()) ring.pop_back();

  const std::size_t w = 3 - base.u - base.h;
  const Rational slope = (base.to[w] - base.from[w]) / (base.to[base.u] - base.from[base.u]);
  std::vector<std::uint32_t> face;
  for (const std::array<Rational, 2>& p : ring) {
    Rational3 x;
    x[base.u] = p[0];
    x[base.h] = p[1];
    x[w] = base.from[w] + slope * (p[0] - base.from[base.u]);
    face.push_back(static_cast<std::uint32_t>(walls.vertices.size()));
    walls.vertices.push_back(std::move(x));
  }
  walls.push_face(face);
}

void WallBuilder::erect(const ReflexEdge& edge, Mesh& walls) {
  const Base base = base_of(point(complex_.svertex_owner[edge.halfedge]), point(complex_.target(edge.halfedge)),
                            static_cast<std::size_t>(edge.axis));
  if (edge.inside[0]) erect(base, false, walls);
  if (edge.inside[1]) erect(base, true, walls);
}

void WallBuilder::erect(const Rational3& from, const Rational3& to, Mesh& walls) {
  const Base base = base_of(from, to, 2);
  erect(base, false, walls);
  erect(base, true, walls);
}

}  // namespace nef::minkowski
