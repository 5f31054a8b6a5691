// SPDX-License-Identifier: Apache-2.0
//
// A vertex is a saddle if neither the solid nor its complement is convex there: several solid or free sfaces, or both
// convex and reflex edges. For each pair of saddles, tests that are cheap and one-sided rule out most candidates: the
// sum lies in a cube that is surely inside. Both solids overlap if a direction into one, turned about the vertex, leads
// into the other one, or if arcs of their boundaries cross. They can be moved apart if the convex hull of one, turned,
// does not enter the other one. What passes all tests becomes a candidate, unless the definition says that the point is
// inside the sum: mostly by an edge and a facet that crossed for the pair before.
#include "apps/minkowski/convolution/marks/interlock.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/minkowski/convolution/facets/near_vector.h"
#include "apps/minkowski/convolution/marks/direction_into.h"
#include "nef/base/fast_path.h"
#include "nef/base/monitor.h"
#include "nef/geometry/vectors.h"
#include "nef/number/approximation.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::minkowski {
// Not anonymous: Saddles has members of these types.
namespace interlock {

// Of the boundary of a solid on the sphere around a vertex: counterclockwise about its normal.
struct Arc {
  Direction normal, from, to;
  Direction between;  // a quarter-turn after `from`, if the arc is a half-turn or more
  int turn = 0;       // 1 if less than a half-turn, 0 if that, -1 if more

  // For a direction on the same great circle.
  [[nodiscard]] bool has_inside(const Direction& d, const Monitor& monitor) const {
    const int after = sign_of_determinant(normal, from, d, monitor);
    const int before = sign_of_determinant(normal, d, to, monitor);
    if (turn > 0) return after > 0 && before > 0;
    return turn == 0 ? after > 0 : after > 0 || before > 0;
  }
};

// An arc in doubles, and on which side of its circle a certain direction is.
struct NearArc {
  NearVector normal, from, to;
  int side = 0;  // 0 if that is not sure
};

// A vertex around which neither the solid nor the rest of space is convex, and some directions into the solid or along
// its edges.
struct Saddle {
  VertexId vertex{0};
  Double3 near{};                     // where it is, about
  Box box;                            // around that
  std::vector<Direction> into, back;  // the second ones are opposite to the first
  std::vector<Arc> arcs;
  std::vector<NearArc> near_arcs;  // all of them, or none
  NearVector near_into;            // a direction into the solid; their sides are its
  /// Of the convex hull of the solid there, unless that is all of space, turned about the vertex: normals, positive
  /// inside, of planes the extreme ones of which bound it; and a direction inside of it.
  std::vector<Direction> turned_hull;
  Direction turned_middle;
};

}  // namespace interlock

namespace {

using interlock::Arc;
using interlock::NearArc;
using interlock::Saddle;
using Directions = std::vector<Direction>;

// Of the svertices of a map, in their order.
Directions directions_of(const Complex& c, const SphereMapView& map) {
  Directions result;
  for (const SVertex& s : map.svertices) result.push_back(direction_of(c.planes, s));
  return result;
}

// Around an edge with one wedge: 1 if that is convex, -1 if it is reflex, 0 if it is flat.
int bend(const Complex& c, const SphereMapView& map, std::uint32_t svertex, const Direction& line,
         const Monitor& monitor) {
  std::uint32_t e = map.svertices[svertex].out;
  while (map.sfaces[map.shalfedges[e].sface].mark != 0) e = map.next_around(e);
  return -orientation_around(c.planes, line, map.shalfedges[e].plane, map.shalfedges[map.next_around(e)].plane,
                             monitor);
}

bool is_saddle(const Complex& c, const SphereMapView& map, const Directions& edges, const Monitor& monitor) {
  const auto solid = std::count_if(map.sfaces.begin(), map.sfaces.end(), [](const SFace& f) { return f.mark != 0; });
  const auto free = static_cast<std::ptrdiff_t>(map.sfaces.size()) - solid;
  if (solid > 1 || free > 1) return true;
  bool convex = false;
  bool reflex = false;
  for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
    const int b = bend(c, map, s, edges[s], monitor);
    convex = convex || b > 0;
    reflex = reflex || b < 0;
  }
  return convex && reflex;
}

// The hull of the edges, if the solid is in it: nothing else can be, if all arcs are short and what is opposite is
// free.
void find_hull(const Complex& c, const SphereMapView& map, const Directions& edges, Saddle& saddle,
               const Monitor& monitor) {
  Integer3 sum;
  for (const Direction& edge : edges) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += edge.integers()[i];
  }
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    const Direction& from = edges[map.shalfedges[e].source];
    const Direction& to = edges[map.target(e)];
    if (orientation_on_circle(c.planes, map.shalfedges[e].plane, from, to, monitor) <= 0) return;
  }
  std::vector<Direction> normals;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < edges.size(); ++j) {
      if (i == j) continue;
      const Direction normal = Direction::cross(edges[i], edges[j]);
      if (normal.is_zero()) continue;
      const bool bounds = std::all_of(edges.begin(), edges.end(),
                                      [&](const Direction& d) { return sign_of_dot(normal, d, monitor) >= 0; });
      if (bounds) normals.push_back(normal.negated());
    }
  }
  if (normals.empty()) return;
  const SphereLocation opposite = locate(c.planes, map, normals.front(), monitor);
  if (opposite.kind != SphereLocation::Kind::kSFace || map.sfaces[opposite.index].mark != 0) return;
  saddle.turned_middle = Direction::exact(sum[0], sum[1], sum[2]).negated();
  saddle.turned_hull = std::move(normals);
}

// What surely_in asks; no arcs if one is not short.
void find_near_arcs(Saddle& saddle) {
  saddle.near_into = near_vector(saddle.into.front());
  for (const Arc& arc : saddle.arcs) {
    if (arc.turn <= 0) {
      saddle.near_arcs.clear();
      return;
    }
    const NearVector normal = near_vector(arc.normal);
    saddle.near_arcs.push_back(
        {normal, near_vector(arc.from), near_vector(arc.to), sure_sign_of_dot(normal, saddle.near_into)});
  }
}

std::vector<Saddle> saddles(const Complex& c, const Monitor& monitor) {
  std::vector<Saddle> result;
  for (const VertexId v : c.vertex_ids()) {
    const SphereMapView map = c.sphere_map(v);
    const Directions edges = directions_of(c, map);
    if (!is_saddle(c, map, edges, monitor)) continue;
    Saddle saddle;
    saddle.vertex = v;
    const Rational3 at = c.points.rational(point_of(v));
    saddle.near = nearest_doubles(at);
    saddle.box.add_rounded(saddle.near);
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      if (map.sfaces[map.shalfedges[e].sface].mark == 0) continue;
      saddle.into.push_back(direction_into(c.planes, map, map.shalfedges[e].sface, e, monitor));
      const Direction& from = edges[map.shalfedges[e].source];
      const Direction& to = edges[map.target(e)];
      const Direction normal = Direction::normal(c.planes, map.shalfedges[e].plane);
      saddle.into.push_back(from);
      const int turn = orientation_on_circle(c.planes, map.shalfedges[e].plane, from, to, monitor);
      saddle.arcs.push_back(
          {normal, from, to, turn > 0 ? Direction() : direction_on_arc(c.planes, map, e, monitor), turn});
    }
    for (const Direction& d : saddle.into) saddle.back.push_back(d.negated());
    find_near_arcs(saddle);
    find_hull(c, map, edges, saddle, monitor);
    result.push_back(std::move(saddle));
  }
  return result;
}

// Whether a direction is in the inside of the solid around a saddle (1) or in that of the rest (-1), if doubles tell;
// else 0. Each arc has the solid on its left and none of it on its right, so the arcs between the direction and one
// into the solid count. Two short arcs cross iff the ends of each are on both sides of the other's circle and they
// cross there on the same half of the sphere: going from d to r one comes to the side sign(n . r) of the other arc's
// circle at sign(n . r) (n x m), and going from `from` to `to` to the side sign(m . to) at sign(m . to) (m x n), m = d
// x r.
int surely_in(const Saddle& saddle, const Direction& direction) {
  if (!kFastPaths || saddle.near_arcs.empty()) return 0;
  const NearVector d = near_vector(direction);
  const NearVector m = near_cross(d, saddle.near_into);
  int result = 1;
  for (const NearArc& arc : saddle.near_arcs) {
    const int of_d = sure_sign_of_dot(arc.normal, d);
    if (of_d == 0 || arc.side == 0) return 0;
    if (of_d == arc.side) continue;
    const int of_from = sure_sign_of_dot(m, arc.from);
    const int of_to = sure_sign_of_dot(m, arc.to);
    if (of_from == 0 || of_to == 0) return 0;
    if (of_from != of_to && of_to == -arc.side) result = -result;
  }
  return result;
}

// True if the part of an arc between two directions, less than a half-turn apart, is in the inside of a convex cone.
bool enters(const std::vector<Direction>& normals, const Direction& from, const Direction& to, const Monitor& monitor) {
  std::vector<std::array<Integer, 2>> forms;  // of (1 - t) from + t to, at t = 0 and 1
  for (const Direction& n : normals) {
    const int at_from = sign_of_dot(n, from, monitor);
    const int at_to = sign_of_dot(n, to, monitor);
    if (at_from <= 0 && at_to <= 0) return false;
    if (at_from > 0 && at_to > 0) continue;
    forms.push_back({dot(n.integers(), from.integers()), dot(n.integers(), to.integers())});
  }
  Rational low = 0;
  Rational high = 1;
  for (const auto& [first, last] : forms) {
    Rational zero(first, first - last);
    zero.canonicalize();
    if (sgn(first) <= 0) {
      low = std::max(low, zero);
    } else {
      high = std::min(high, zero);
    }
  }
  return low < high;
}

// True if the convex hull of one solid at its saddle, turned about that, surely does not enter the other one.
bool fits(const Complex& c, const Saddle& saddle, const Saddle& other, const Monitor& monitor) {
  const std::vector<Direction>& hull = other.turned_hull;
  if (hull.empty()) return false;
  for (const Arc& arc : saddle.arcs) {
    if (arc.turn > 0) {
      if (enters(hull, arc.from, arc.to, monitor)) return false;
      continue;
    }
    if (enters(hull, arc.from, arc.between, monitor)) return false;
    if (arc.turn == 0) {
      if (enters(hull, arc.between, arc.to, monitor)) return false;
    } else if (enters(hull, arc.between, arc.from.negated(), monitor) ||
               enters(hull, arc.from.negated(), arc.to, monitor)) {
      return false;
    }
  }
  if (const int where = surely_in(saddle, other.turned_middle); where != 0) return where < 0;
  const SphereMapView map = c.sphere_map(saddle.vertex);
  const SphereLocation at = locate(c.planes, map, other.turned_middle, monitor);
  return at.kind == SphereLocation::Kind::kSFace && map.sfaces[at.index].mark == 0;
}

// Whether a short arc crosses another one, turned about the vertex (1) or does not even touch it (-1), if doubles tell;
// else 0. As in surely_in; the normal of an arc stays as it is when the arc is turned.
int surely_cross(const NearArc& a, const NearArc& b) {
  const int b_from = -sure_sign_of_dot(a.normal, b.from);
  const int b_to = -sure_sign_of_dot(a.normal, b.to);
  if (b_from != 0 && b_from == b_to) return -1;
  const int a_from = sure_sign_of_dot(b.normal, a.from);
  const int a_to = sure_sign_of_dot(b.normal, a.to);
  if (a_from != 0 && a_from == a_to) return -1;
  if (b_from == 0 || b_to == 0 || a_from == 0 || a_to == 0) return 0;
  return a_to == -b_to ? 1 : -1;
}

// True if an arc of one crosses one of the other, turned about the vertex: where both are, there is the inside of both.
bool arcs_cross(const Saddle& s, const Saddle& t, const Monitor& monitor) {
  const bool are_near = kFastPaths && !s.near_arcs.empty() && !t.near_arcs.empty();
  for (std::size_t i = 0; i < s.arcs.size(); ++i) {
    for (std::size_t k = 0; k < t.arcs.size(); ++k) {
      const int sure = are_near ? surely_cross(s.near_arcs[i], t.near_arcs[k]) : 0;
      if (sure > 0) return true;
      if (sure < 0) continue;
      const Arc& a = s.arcs[i];
      const Arc& b = t.arcs[k];
      const Direction d = Direction::cross(a.normal, b.normal);
      if (d.is_zero()) continue;
      const Direction e = d.negated();
      if ((a.has_inside(d, monitor) && b.has_inside(e, monitor)) ||
          (a.has_inside(e, monitor) && b.has_inside(d, monitor)))
        return true;
    }
  }
  return false;
}

// What the nearest double of a number tells.
Approximation rounded(double x) { return {x, std::fabs(x) * kRoundingUnit + 1e-300}; }

bool holds_one(const Complex& c, const Saddle& saddle, const std::vector<Direction>& directions,
               const Monitor& monitor) {
  std::vector<const Direction*> unsure;
  for (const Direction& d : directions) {
    const int where = surely_in(saddle, d);
    if (where > 0) return true;
    if (where == 0) unsure.push_back(&d);
  }
  const SphereMapView map = c.sphere_map(saddle.vertex);
  return std::any_of(unsure.begin(), unsure.end(), [&](const Direction* d) {
    const SphereLocation at = locate(c.planes, map, *d, monitor);
    return at.kind == SphereLocation::Kind::kSFace && map.sfaces[at.index].mark != 0;
  });
}

}  // namespace

Saddles::Saddles(const Polyhedron& solid, const Monitor& monitor)
    : solid_(solid), all_(std::make_shared<const std::vector<Saddle>>(saddles(solid_.complex(), monitor))) {}

std::vector<SaddlePoint> saddle_points(const Saddles& a, const Saddles& b, const SumMembership& membership,
                                       const CoveredVoxels& covered, const Monitor& monitor, const NearOrigin& near) {
  const Complex& of_a = a.solid().complex();
  const Complex& of_b = b.solid().complex();
  std::vector<SaddlePoint> result;
  IntersectionQuery::Crossings recent;
  for (const Saddle& s : a.all()) {
    monitor.check_interruption();
    for (const Saddle& t : b.all()) {
      if (!near.is_all() && !near.may_hold(s.box, t.box)) continue;
      const Double3 about = {s.near[0] + t.near[0], s.near[1] + t.near[1], s.near[2] + t.near[2]};
      if (covered.cover({&about, 1})) continue;
      if (holds_one(of_a, s, t.back, monitor) || holds_one(of_b, t, s.back, monitor)) continue;
      if (arcs_cross(s, t, monitor) || fits(of_a, s, t, monitor) || fits(of_b, t, s, monitor)) continue;
      Approximation3 around;
      for (std::size_t i = 0; i < 3; ++i) around[i] = rounded(s.near[i]) + rounded(t.near[i]);
      if (membership.surely_in_inside(around, recent, true, monitor)) continue;
      const Rational3 p = of_a.points.rational(point_of(s.vertex));
      const Rational3 q = of_b.points.rational(point_of(t.vertex));
      const bool marked = of_a.mark(s.vertex) != 0 && of_b.mark(t.vertex) != 0;
      result.push_back({plus(p, q), static_cast<std::uint8_t>(marked ? 1 : 0)});
    }
  }
  return result;
}

}  // namespace nef::minkowski
