// SPDX-License-Identifier: Apache-2.0
//
// A vertex is a saddle if neither the solid nor its complement is convex there: several solid or free sfaces, or both
// convex and reflex edges. For each pair of saddles, tests that are cheap and one-sided rule out most candidates. Both
// solids overlap if a direction into one, turned about the vertex, leads into the other one, or if arcs of their
// boundaries cross. They can be moved apart if the convex hull of one, turned, does not enter the other one. What
// passes all tests becomes a candidate, unless the definition says that the point is inside the sum.
#include "apps/minkowski/convolution/marks/interlock.h"

#include <algorithm>
#include <array>

#include "apps/minkowski/convolution/marks/direction_into.h"
#include "nef/base/monitor.h"
#include "nef/geometry/vectors.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::minkowski {
namespace {

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

// A vertex around which neither the solid nor the rest of space is convex, and some directions into the solid or along
// its edges.
struct Saddle {
  VertexId vertex{0};
  std::vector<Direction> into, back;  // the second ones are opposite to the first
  std::vector<Arc> arcs;
  /// Of the convex hull of the solid there, unless that is all of space, turned about the vertex: normals, positive
  /// inside, of planes the extreme ones of which bound it; and a direction inside of it.
  std::vector<Direction> turned_hull;
  Direction turned_middle;
};

// Around an edge with one wedge: 1 if that is convex, -1 if it is reflex, 0 if it is flat.
int bend(const Complex& c, const SphereMapView& map, std::uint32_t svertex, const Monitor& monitor) {
  const Direction line = direction_of(c.planes, map.svertices[svertex]);
  std::uint32_t e = map.svertices[svertex].out;
  while (map.sfaces[map.shalfedges[e].sface].mark != 0) e = map.next_around(e);
  return -orientation_around(c.planes, line, map.shalfedges[e].plane, map.shalfedges[map.next_around(e)].plane,
                             monitor);
}

bool is_saddle(const Complex& c, const SphereMapView& map, const Monitor& monitor) {
  const auto solid = std::count_if(map.sfaces.begin(), map.sfaces.end(), [](const SFace& f) { return f.mark != 0; });
  const auto free = static_cast<std::ptrdiff_t>(map.sfaces.size()) - solid;
  if (solid > 1 || free > 1) return true;
  bool convex = false;
  bool reflex = false;
  for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
    const int b = bend(c, map, s, monitor);
    convex = convex || b > 0;
    reflex = reflex || b < 0;
  }
  return convex && reflex;
}

// The hull of the edges, if the solid is in it: nothing else can be, if all arcs are short and what is opposite is
// free.
void find_hull(const Complex& c, const SphereMapView& map, Saddle& saddle, const Monitor& monitor) {
  std::vector<Direction> edges;
  Integer3 sum;
  for (const SVertex& s : map.svertices) {
    edges.push_back(direction_of(c.planes, s));
    for (std::size_t i = 0; i < 3; ++i) sum[i] += edges.back().integers()[i];
  }
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    const Direction from = direction_of(c.planes, map.svertices[map.shalfedges[e].source]);
    const Direction to = direction_of(c.planes, map.svertices[map.target(e)]);
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

std::vector<Saddle> saddles(const Complex& c, const Monitor& monitor) {
  std::vector<Saddle> result;
  for (const VertexId v : c.vertex_ids()) {
    const SphereMapView map = c.sphere_map(v);
    if (!is_saddle(c, map, monitor)) continue;
    Saddle saddle;
    saddle.vertex = v;
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      if (map.sfaces[map.shalfedges[e].sface].mark == 0) continue;
      saddle.into.push_back(direction_into(c.planes, map, map.shalfedges[e].sface, e, monitor));
      const Direction from = direction_of(c.planes, map.svertices[map.shalfedges[e].source]);
      const Direction to = direction_of(c.planes, map.svertices[map.target(e)]);
      const Direction normal = Direction::normal(c.planes, map.shalfedges[e].plane);
      saddle.into.push_back(from);
      const int turn = orientation_on_circle(c.planes, map.shalfedges[e].plane, from, to, monitor);
      saddle.arcs.push_back(
          {normal, from, to, turn > 0 ? Direction() : direction_on_arc(c.planes, map, e, monitor), turn});
    }
    for (const Direction& d : saddle.into) saddle.back.push_back(d.negated());
    find_hull(c, map, saddle, monitor);
    result.push_back(std::move(saddle));
  }
  return result;
}

// True if the part of an arc between two directions, less than a half-turn apart, is in the inside of a convex cone.
bool enters(const std::vector<Direction>& normals, const Direction& from, const Direction& to, const Monitor& monitor) {
  std::vector<std::array<Integer, 2>> forms;  // of (1 - t) from + t to, at t = 0 and 1
  for (const Direction& n : normals) {
    if (sign_of_dot(n, from, monitor) <= 0 && sign_of_dot(n, to, monitor) <= 0) return false;
    forms.push_back({dot(n.integers(), from.integers()), dot(n.integers(), to.integers())});
  }
  Rational low = 0;
  Rational high = 1;
  for (const auto& [first, last] : forms) {
    if (sgn(first) > 0 && sgn(last) > 0) continue;
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
  const SphereMapView map = c.sphere_map(saddle.vertex);
  const SphereLocation at = locate(c.planes, map, other.turned_middle, monitor);
  return at.kind == SphereLocation::Kind::kSFace && map.sfaces[at.index].mark == 0;
}

// True if an arc of one crosses one of the other, turned about the vertex: where both are, there is the inside of both.
bool cross(const Saddle& s, const Saddle& t, const Monitor& monitor) {
  for (const Arc& a : s.arcs) {
    for (const Arc& b : t.arcs) {
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

bool holds_one(const Complex& c, VertexId vertex, const std::vector<Direction>& directions, const Monitor& monitor) {
  const SphereMapView map = c.sphere_map(vertex);
  return std::any_of(directions.begin(), directions.end(), [&](const Direction& d) {
    const SphereLocation at = locate(c.planes, map, d, monitor);
    return at.kind == SphereLocation::Kind::kSFace && map.sfaces[at.index].mark != 0;
  });
}

}  // namespace

std::vector<SaddlePoint> saddle_points(const Polyhedron& a, const Polyhedron& b, const SumMembership& membership,
                                       const Monitor& monitor) {
  const Complex& of_a = a.complex();
  const Complex& of_b = b.complex();
  const std::vector<Saddle> saddles_a = saddles(of_a, monitor);
  const std::vector<Saddle> saddles_b = saddles(of_b, monitor);
  std::vector<SaddlePoint> result;
  for (const Saddle& s : saddles_a) {
    monitor.check_interruption();
    for (const Saddle& t : saddles_b) {
      if (holds_one(of_a, s.vertex, t.back, monitor) || holds_one(of_b, t.vertex, s.back, monitor)) continue;
      if (cross(s, t, monitor) || fits(of_a, s, t, monitor) || fits(of_b, t, s, monitor)) continue;
      const Rational3 p = of_a.points.rational(point_of(s.vertex));
      const Rational3 q = of_b.points.rational(point_of(t.vertex));
      const Rational3 x = {p[0] + q[0], p[1] + q[1], p[2] + q[2]};
      if (membership.surely_in_inside(x, monitor)) continue;
      const bool marked = of_a.mark(s.vertex) != 0 && of_b.mark(t.vertex) != 0;
      result.push_back({x, static_cast<std::uint8_t>(marked ? 1 : 0)});
    }
  }
  return result;
}

}  // namespace nef::minkowski
