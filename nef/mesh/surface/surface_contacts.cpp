// SPDX-License-Identifier: Apache-2.0
//
// The line in which the planes of two triangles meet cuts each triangle in an interval whose ends lie on edges. With
// p1 x an edge of the first and p2 y one of the second, p1 and p2 off the other's plane, the order of the
// two ends along n1 x n2 is the sign of orientation(p1, x, p2, y) times the sides of p1 and p2 (expand the determinant
// from the ends of the edges on the line). So no intersection point is ever computed.
#include "nef/mesh/surface/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "nef/geometry/vectors.h"

namespace nef {
namespace {

using Triangle = SurfaceContacts::Triangle;
using Signs = std::array<int, 3>;

bool one_sided(const Signs& s) {
  const bool positive = s[0] > 0 || s[1] > 0 || s[2] > 0;
  const bool negative = s[0] < 0 || s[1] < 0 || s[2] < 0;
  return positive != negative;
}
int zeros(const Signs& s) { return (s[0] == 0 ? 1 : 0) + (s[1] == 0 ? 1 : 0) + (s[2] == 0 ? 1 : 0); }

// What separating vectors are tried with. For each point the product with a vector d is off by at most |d| times the
// margin of the points and 4 u |d| |p|, for each coordinate; the bound is what the products of two points are off by.
// What vanishes in a product is below 2^-1074, in all of it far below 1e-300. The points are moderate and d is of order
// three at most in their differences, so nothing overflows; a d that is infinite or no number, which a side of length 0
// makes, has a bound that is, and separates nothing.
class Separation {
 public:
  Separation(const MeshPoints& points, const Triangle& a, const Triangle& b) : points_(points) {
    for (const Triangle* t : {&a, &b}) {
      for (const std::uint32_t v : *t) {
        for (std::size_t i = 0; i < 3; ++i) reach_[i] = std::max(reach_[i], std::abs(points.approximate(v)[i]));
      }
    }
    for (std::size_t i = 0; i < 3; ++i) reach_[i] = points.margin(i) + 0x1p-50 * reach_[i];
  }

  // True if all of the first are surely below all of the second.
  [[nodiscard]] bool below(const Double3& d, std::span<const std::uint32_t> first,
                           std::span<const std::uint32_t> second) const {
    double high = -HUGE_VAL;
    double low = HUGE_VAL;
    for (const std::uint32_t v : first) high = std::max(high, dot(d, points_.approximate(v)));
    for (const std::uint32_t v : second) low = std::min(low, dot(d, points_.approximate(v)));
    const double bound = 2 * (std::abs(d[0]) * reach_[0] + std::abs(d[1]) * reach_[1] + std::abs(d[2]) * reach_[2]);
    return low - high > bound + 1e-300;
  }

 private:
  const MeshPoints& points_;
  Double3 reach_{};
};

// Any vector proves two triangles disjoint if their images on it are disjoint, however the vector was come by. Tried
// are the first triangle's normal, and in its plane and the other's those across their edges.
bool surely_apart(const MeshPoints& points, const Triangle& a, const Triangle& b) {
  if (!points.moderate()) return false;
  const Separation separation(points, a, b);
  const auto separates = [&](const Double3& d) { return separation.below(d, a, b) || separation.below(d, b, a); };
  for (const Triangle* t : {&a, &b}) {
    std::array<Double3, 3> edge;
    for (std::size_t k = 0; k < 3; ++k) {
      edge[k] = minus(points.approximate((*t)[(k + 1) % 3]), points.approximate((*t)[k]));
    }
    const Double3 normal = cross(edge[0], edge[1]);
    if (separates(normal)) return true;
    for (const Double3& e : edge) {
      if (separates(cross(normal, e))) return true;
    }
  }
  return false;
}

// The same of triangles with one common corner: if a plane through it has all else of each on its own side, the corner
// is all that they share. Tried are, for triangles in about one plane, those between two of their sides.
bool surely_apart_but_for(const MeshPoints& points, std::uint32_t corner, const Triangle& a, const Triangle& b) {
  if (!points.moderate()) return false;
  const Separation separation(points, a, b);
  const std::array<std::uint32_t, 1> common{corner};
  std::array<std::array<std::uint32_t, 2>, 2> others{};  // of a and b
  std::array<std::array<Double3, 2>, 2> sides{};         // from the corner, of length one
  for (std::size_t i = 0; i < 2; ++i) {
    std::size_t count = 0;
    for (const std::uint32_t v : i == 0 ? a : b) {
      if (v == corner) continue;
      const Double3 side = minus(points.approximate(v), points.approximate(corner));
      const double length = std::sqrt(dot(side, side));
      sides[i][count] = {side[0] / length, side[1] / length, side[2] / length};
      others[i][count++] = v;
    }
  }
  const Double3 normal = cross(sides[0][0], sides[0][1]);
  for (const Double3& u : sides[0]) {
    for (const Double3& v : sides[1]) {
      const Double3 d = cross(normal, Double3{u[0] + v[0], u[1] + v[1], u[2] + v[2]});
      if (separation.below(d, others[0], common) && separation.below(d, common, others[1])) return true;
      if (separation.below(d, others[1], common) && separation.below(d, common, others[0])) return true;
    }
  }
  return false;
}

// True if the angle at p q between the triangles with these apexes is surely more than a right one: the parts of the
// two that are perpendicular to the edge have a negative product, (a x e) (b x e). With all differences below m, each
// within e of the truth and 2^-53 m <= e, the products of two are off by 9 e m, those of four by 36 e m^3 each, and
// sums of three of these round by less than 48 e m^3.
bool surely_obtuse(const MeshPoints& points, std::uint32_t p, std::uint32_t q, std::uint32_t a, std::uint32_t b) {
  if (!points.moderate()) return false;
  const Double3& origin = points.approximate(p);
  const Double3 edge = minus(points.approximate(q), origin);
  const Double3 u = minus(points.approximate(a), origin);
  const Double3 v = minus(points.approximate(b), origin);
  double largest = 0;
  double margin = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    largest = std::max({largest, std::abs(edge[i]), std::abs(u[i]), std::abs(v[i])});
    margin = std::max(margin, points.margin(i));
  }
  largest = largest * (1 + 0x1p-50) + 2 * margin;
  const double error = 2 * margin + 0x1p-53 * largest;
  return dot(cross(u, edge), cross(v, edge)) < -(200 * error * largest * largest * largest + 1e-200);
}

bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

}  // namespace

// The part of a triangle on the common line: from the point on edge (apex, low) to that on (apex, high), ordered along
// n1 x n2. A vertex that only touches the line has low == high.
struct SurfaceContacts::Interval {
  std::uint32_t apex = 0, low = 0, high = 0;
  int side = 0;  // of the apex
  Edge edge;     // if it is an edge of the triangle
  [[nodiscard]] bool point() const { return low == high; }
};

namespace {

template <typename Interval>
Interval make_interval(const Triangle& t, const Signs& s, bool first) {
  Interval result;
  if (one_sided(s) && zeros(s) == 1) {
    std::size_t on = 0;
    while (s[on] != 0) ++on;
    result.apex = t[(on + 1) % 3];
    result.side = s[(on + 1) % 3];
    result.low = result.high = t[on];
    return result;
  }
  // The corner that is alone on its side: both others are on the other side or on the plane.
  std::size_t alone = 0;
  while (s[alone] == 0 || s[alone] * s[(alone + 1) % 3] > 0 || s[alone] * s[(alone + 2) % 3] > 0) ++alone;
  const std::uint32_t q = t[(alone + 1) % 3];
  const std::uint32_t r = t[(alone + 2) % 3];
  result.apex = t[alone];
  result.side = s[alone];
  // From q's end to r's end runs against n1 x n2 for the first triangle if its apex is on the positive side, and along
  // it for the second.
  const bool swap = (result.side > 0) == first;
  result.low = swap ? r : q;
  result.high = swap ? q : r;
  if (zeros(s) == 2) result.edge = {q, r, true};
  return result;
}

}  // namespace

SurfaceContacts::SurfaceContacts(const MeshSurface& surface, const Monitor& monitor)
    : points_(surface.points),
      triangles_(surface.triangles),
      face_of_(surface.face_of),
      patches_(surface, monitor),
      monitor_(monitor) {}

// The side of a triangle's plane on which a place lies. Corners of a planar face lie in it by definition, which spares
// the exact arithmetic that finding a zero costs.
int SurfaceContacts::side(std::uint32_t triangle, std::uint32_t place) const {
  if (patches_.on_plane(triangle, place)) return 0;
  const Triangle& t = triangles_[triangle];
  return points_.orientation(t[0], t[1], t[2], place, monitor_);
}

// All triangles at an edge, in their order; they are among those at either end, of which the one with fewer is asked.
std::vector<SurfaceContacts::HalfEdge> SurfaceContacts::around(std::uint32_t u, std::uint32_t v) const {
  if (patches_.stars().star(v).size() < patches_.stars().star(u).size()) std::swap(u, v);
  const int leaving = u < v ? 1 : -1;
  std::vector<HalfEdge> result;
  for (const VertexStars::Wedge& wedge : patches_.stars().star(u)) {
    if (wedge.from == v) result.push_back({wedge.triangle, wedge.to, leaving});
    if (wedge.to == v) result.push_back({wedge.triangle, wedge.from, -leaving});
  }
  return result;
}

SurfaceContacts::Around SurfaceContacts::around_segment(std::uint32_t u, std::uint32_t v,
                                                        std::span<const Wing> wings) const {
  if (wings.size() == 2) return {wings[0].direction != wings[1].direction, false};
  const std::uint32_t base = wings[0].apex;
  const std::size_t axis = points_.projection_axis(u, v, base, monitor_);
  // 0: with the first wing, 1: less than a half-turn after it, 2: opposite, 3: more.
  const auto sector = [&](std::uint32_t apex) {
    const int turn = apex == base ? 0 : points_.orientation(u, v, base, apex, monitor_);
    if (turn != 0) return turn > 0 ? 1 : 3;
    return points_.orientation_along(u, v, base, axis, monitor_) ==
                   points_.orientation_along(u, v, apex, axis, monitor_)
               ? 0
               : 2;
  };
  struct Sorted {
    int sector = 0;
    Wing wing;
  };
  std::vector<Sorted> sorted;
  for (const Wing& wing : wings) sorted.push_back({sector(wing.apex), wing});
  const auto order = [&](const Sorted& a, const Sorted& b) {
    if (a.sector != b.sector) return a.sector < b.sector ? 1 : -1;
    return a.sector % 2 == 0 ? 0 : points_.orientation(u, v, a.wing.apex, b.wing.apex, monitor_);
  };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Sorted& a, const Sorted& b) { return order(a, b) > 0; });
  int level = 0;  // how often the space after the wings so far is wound around, but for a constant
  int lowest = 0;
  int highest = 0;
  bool second_alone = false;  // since the last wing of the first surface
  std::size_t sectors = 0;    // of the first surface that the second enters
  bool wraps = false;         // it enters the one that holds the beginning
  bool first_seen = false;
  for (std::size_t i = 0; i < sorted.size();) {
    bool any_first = false;
    std::size_t end = i;
    for (; end < sorted.size() && order(sorted[i], sorted[end]) == 0; ++end) {
      level += sorted[end].wing.direction;
      any_first = any_first || !sorted[end].wing.second;
    }
    lowest = std::min(lowest, level);
    highest = std::max(highest, level);
    if (any_first) {
      second_alone = false;
    } else if (!second_alone) {
      second_alone = true;
      ++sectors;
      wraps = wraps || !first_seen;
    }
    first_seen = first_seen || any_first;
    i = end;
  }
  if (wraps && second_alone && sectors > 1) --sectors;  // the last sector is the first one
  return {level == 0 && highest - lowest <= 1, sectors > 1};
}

void SurfaceContacts::for_each_bad_edge(
    const std::function<bool(std::uint32_t, std::uint32_t, std::span<const std::uint32_t>)>& visit) const {
  struct Spoke {
    std::uint32_t to = 0;  // the larger end of the edge
    HalfEdge half;
  };
  std::vector<Spoke> spokes;
  for (std::uint32_t u = 0; u < points_.size(); ++u) {
    spokes.clear();
    for (const VertexStars::Wedge& wedge : patches_.stars().star(u)) {
      if (wedge.from > u) spokes.push_back({wedge.from, {wedge.triangle, wedge.to, 1}});
      if (wedge.to > u) spokes.push_back({wedge.to, {wedge.triangle, wedge.from, -1}});
    }
    std::stable_sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) { return a.to < b.to; });
    for (std::size_t first = 0, last = 0; first < spokes.size(); first = last) {
      int balance = 0;
      for (; last < spokes.size() && spokes[last].to == spokes[first].to; ++last)
        balance += spokes[last].half.direction;
      if (last - first <= 2 || balance != 0) continue;
      std::vector<Wing> wings;
      std::vector<std::uint32_t> triangles;
      for (const Spoke& spoke : std::span(spokes).subspan(first, last - first)) {
        wings.push_back({spoke.half.apex, spoke.half.direction});
        triangles.push_back(spoke.half.triangle);
      }
      const std::uint32_t v = spokes[first].to;
      if (!around_segment(u, v, wings).separates && !visit(u, v, triangles)) return;
    }
  }
}

// True if the two segments, on one line, run the same way.
bool SurfaceContacts::same_direction(Edge a, Edge b) const {
  return (points_.compare(a.u, a.v) < 0) == (points_.compare(b.u, b.v) < 0);
}

// Adds the triangles around the segment `along`: all at an edge of this triangle, or the two sides of the triangle
// if the segment runs through it. Returns false if they are not balanced.
bool SurfaceContacts::add_wings(std::uint32_t triangle, Edge own, Edge along, bool second,
                                std::vector<Wing>& wings) const {
  if (own.valid) {
    const bool same = same_direction(own, along);
    int balance = 0;
    for (const HalfEdge& h : around(own.u, own.v)) {
      const int direction = (own.u < own.v) == same ? h.direction : -h.direction;
      wings.push_back({h.apex, direction, second});
      balance += direction;
    }
    return balance == 0;
  }
  // Corners on either side of the segment, and whether the triangle turns like (u, v, corner).
  const Triangle& t = triangles_[triangle];
  const std::size_t axis = points_.projection_axis(t[0], t[1], t[2], monitor_);
  const int orientation = points_.orientation_along(t[0], t[1], t[2], axis, monitor_);
  bool left = false;
  bool right = false;
  for (const std::uint32_t corner : t) {
    const int turn = points_.orientation_along(along.u, along.v, corner, axis, monitor_);
    bool& done = turn > 0 ? left : right;
    if (turn == 0 || done) continue;
    done = true;
    wings.push_back({corner, turn == orientation ? 1 : -1, second});
  }
  return left && right;
}

SurfaceContacts::Kind SurfaceContacts::resolve_segment(std::uint32_t t, Edge t_edge, std::uint32_t u,
                                                       Edge u_edge) const {
  std::vector<Wing> wings;
  const Edge along = t_edge.valid ? t_edge : u_edge;
  const bool balanced_t = add_wings(t, t_edge, along, false, wings);
  const bool balanced_u = add_wings(u, u_edge, along, true, wings);
  // An open or badly oriented surface bounds nothing that could be crossed; that is reported by itself.
  if (!balanced_t || !balanced_u) return Kind::kTouch;
  const Around around = around_segment(along.u, along.v, wings);
  return around.interleaved && !around.separates ? Kind::kCross : Kind::kTouch;
}

// Of triangles with one common corner: false means that doubles can not tell.
bool SurfaceContacts::meet_in_corner(std::uint32_t t, std::uint32_t u) const {
  const Triangle& a = triangles_[t];
  const Triangle& b = triangles_[u];
  std::uint32_t corner = 0;
  int side = 0;
  bool one_side = true;
  for (const std::uint32_t v : b) {
    if (has(a, v)) {
      corner = v;
      continue;
    }
    const int sign = points_.determinant(a[0], a[1], a[2], v).sign().value_or(0);
    one_side = one_side && sign != 0 && sign != -side;
    side = sign;
  }
  return one_side || surely_apart_but_for(points_, corner, a, b);
}

SurfaceContacts::Kind SurfaceContacts::classify_general(std::uint32_t t, std::uint32_t u, int shared) const {
  const Triangle& a = triangles_[t];
  const Triangle& b = triangles_[u];
  if (shared == 0 && surely_apart(points_, a, b)) return Kind::kNone;
  if (shared == 1 && meet_in_corner(t, u)) return Kind::kNone;
  Signs sb{};
  for (std::size_t i = 0; i < 3; ++i) {
    sb[i] = shared > 0 && has(a, b[i]) ? 0 : side(t, b[i]);
  }
  if (one_sided(sb) && zeros(sb) == shared) return Kind::kNone;
  if (zeros(sb) == 3) return classify_coplanar(t, u, shared);
  Signs sa{};
  for (std::size_t i = 0; i < 3; ++i) {
    sa[i] = shared > 0 && has(b, a[i]) ? 0 : side(u, a[i]);
  }
  if (one_sided(sa) && zeros(sa) == shared) return Kind::kNone;
  const auto ia = make_interval<Interval>(a, sa, true);
  const auto ib = make_interval<Interval>(b, sb, false);
  // Positive if the end on edge (b.apex, y) comes after the end on (a.apex, x).
  const auto order = [&](std::uint32_t x, std::uint32_t y) {
    if (x == y) return 0;  // a shared vertex on the line
    return points_.orientation(ia.apex, x, ib.apex, y, monitor_) * ia.side * ib.side;
  };
  const int low_high = order(ia.low, ib.high);
  const int high_low = order(ia.high, ib.low);
  if (low_high < 0 || high_low > 0) return Kind::kNone;
  if (low_high == 0 || high_low == 0 || ia.point() || ib.point()) {
    return shared > 0 ? Kind::kNone : Kind::kTouch;
  }
  if (!ia.edge.valid && !ib.edge.valid) return Kind::kCross;
  return resolve_segment(t, ia.edge, u, ib.edge);
}

// True if two triangles in one plane turn the same way.
bool SurfaceContacts::turned_alike(const Triangle& a, const Triangle& b) const {
  const std::size_t axis = points_.projection_axis(a[0], a[1], a[2], monitor_);
  return points_.orientation_along(a[0], a[1], a[2], axis, monitor_) ==
         points_.orientation_along(b[0], b[1], b[2], axis, monitor_);
}

SurfaceContacts::Kind SurfaceContacts::classify_coplanar(std::uint32_t t, std::uint32_t u, int shared) const {
  const Triangle& a = triangles_[t];
  const Triangle& b = triangles_[u];
  const std::size_t axis = points_.projection_axis(a[0], a[1], a[2], monitor_);
  // Two convex sets have disjoint interiors iff an edge line of one separates them.
  bool apart = false;
  bool interiors_apart = false;
  const auto separate = [&](const Triangle& x, const Triangle& y) {
    const int inside = points_.orientation_along(x[0], x[1], x[2], axis, monitor_);
    for (std::size_t i = 0; i < 3; ++i) {
      int largest = -1;
      for (const std::uint32_t p : y) {
        largest = std::max(largest, inside * points_.orientation_along(x[i], x[(i + 1) % 3], p, axis, monitor_));
      }
      apart = apart || largest < 0;
      interiors_apart = interiors_apart || largest <= 0;
    }
  };
  separate(a, b);
  separate(b, a);
  if (apart) return Kind::kNone;
  if (!interiors_apart) return turned_alike(a, b) ? Kind::kOverlap : Kind::kCover;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Edge e{a[i], a[(i + 1) % 3], true};
      const Edge f{b[j], b[(j + 1) % 3], true};
      if ((e.u == f.u && e.v == f.v) || (e.u == f.v && e.v == f.u)) continue;
      if (points_.orientation_along(e.u, e.v, f.u, axis, monitor_) != 0 ||
          points_.orientation_along(e.u, e.v, f.v, axis, monitor_) != 0) {
        continue;
      }
      const bool e_up = points_.compare(e.u, e.v) < 0;
      const bool f_up = points_.compare(f.u, f.v) < 0;
      if (points_.compare(e_up ? e.u : e.v, f_up ? f.v : f.u) < 0 &&
          points_.compare(f_up ? f.u : f.v, e_up ? e.v : e.u) < 0) {
        return resolve_segment(t, e, u, f);
      }
    }
  }
  return shared > 0 ? Kind::kNone : Kind::kTouch;
}

SurfaceContacts::Kind SurfaceContacts::classify(std::uint32_t t, std::uint32_t u) const {
  const Triangle& a = triangles_[t];
  const Triangle& b = triangles_[u];
  int shared = 0;
  std::size_t a_free = 0;  // a corner that is not shared
  std::size_t b_free = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (has(b, a[i])) {
      ++shared;
    } else {
      a_free = i;
    }
    if (!has(a, b[i])) b_free = i;
  }
  if (shared < 2) return classify_general(t, u, shared);
  if (shared == 3) return turned_alike(a, b) ? Kind::kOverlap : Kind::kCover;
  return classify_neighbours(t, u, a_free, b_free);
}

// Two triangles with a common edge, given the corners that they do not share.
SurfaceContacts::Kind SurfaceContacts::classify_neighbours(std::uint32_t t, std::uint32_t u, std::size_t t_free,
                                                           std::size_t u_free) const {
  const Triangle& a = triangles_[t];
  const Triangle& b = triangles_[u];
  const std::uint32_t p = a[(t_free + 1) % 3];
  const std::uint32_t q = a[(t_free + 2) % 3];
  const bool cut = patches_.is_cut(t, p, q) || patches_.is_cut(u, p, q);
  if (!cut && surely_obtuse(points_, p, q, a[t_free], b[u_free])) return Kind::kNone;
  if (side(t, b[u_free]) == 0) {
    // Coplanar neighbours overlap if they lie on one side of their edge.
    const std::size_t axis = points_.projection_axis(a[0], a[1], a[2], monitor_);
    const bool same_side = points_.orientation_along(p, q, a[t_free], axis, monitor_) ==
                           points_.orientation_along(p, q, b[u_free], axis, monitor_);
    if (!same_side) return Kind::kNone;
    return turned_alike(a, b) ? Kind::kOverlap : Kind::kCover;
  }
  // A cut through a planar face is no edge of the surface, so what else lies on it touches the face from one side.
  if (!cut) return Kind::kNone;
  std::vector<Wing> wings;
  int balance = 0;
  const std::uint32_t face = face_of_[patches_.is_cut(t, p, q) ? t : u];
  for (const HalfEdge& h : around(p, q)) {
    wings.push_back({h.apex, h.direction, face_of_[h.triangle] != face});
    balance += h.direction;
  }
  if (balance != 0) return Kind::kTouch;
  const Around around = around_segment(std::min(p, q), std::max(p, q), wings);
  return around.interleaved && !around.separates ? Kind::kCross : Kind::kTouch;
}

void SurfaceContacts::for_each(const std::function<bool(Kind, std::uint32_t, std::uint32_t)>& visit,
                               OpenPairs* open) const {
  struct Contact {
    std::uint32_t t = 0, u = 0;
    Kind kind = Kind::kNone;
  };
  std::vector<Contact> contacts;
  const std::size_t most_open = triangles_.size() / 32 + 32;
  patches_.for_each_candidate([&](std::uint32_t t, std::uint32_t u) {
    try {
      const Kind kind = classify(t, u);
      if (kind != Kind::kNone) contacts.push_back({t, u, kind});
    } catch (const OpenQuestion&) {
      if (open == nullptr || open->size() == most_open) throw;
      open->push_back({t, u});
    }
  });
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& a, const Contact& b) { return a.t != b.t ? a.t < b.t : a.u < b.u; });
  for (const Contact& contact : contacts) {
    if (!visit(contact.kind, contact.t, contact.u)) return;
  }
}

std::vector<FaceContact> face_contacts(const MeshSurface& surface, const SurfaceContacts& contacts, OpenPairs* open) {
  // Triangles of one face meet others' many times.
  std::vector<FaceContact> found;
  const auto add = [&](SurfaceContacts::Kind kind, std::uint32_t t, std::uint32_t u) {
    const auto [f, g] = std::minmax(surface.face_of[t], surface.face_of[u]);
    found.push_back({f, g, kind, kind == SurfaceContacts::Kind::kCover});
    return true;
  };
  contacts.for_each(add, open);
  std::sort(found.begin(), found.end(), [](const FaceContact& a, const FaceContact& b) {
    return std::tie(a.f, a.g, b.kind) < std::tie(b.f, b.g, a.kind);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (kept > 0 && found[kept - 1].f == found[i].f && found[kept - 1].g == found[i].g) {
      found[kept - 1].covers = found[kept - 1].covers || found[i].covers;
    } else {
      found[kept++] = found[i];
    }
  }
  found.resize(kept);
  return found;
}

std::size_t count_crossings(std::span<const FaceContact> contacts) {
  return static_cast<std::size_t>(std::count_if(contacts.begin(), contacts.end(), [](const FaceContact& contact) {
    return contact.kind == SurfaceContacts::Kind::kCross || contact.kind == SurfaceContacts::Kind::kOverlap;
  }));
}

}  // namespace nef
