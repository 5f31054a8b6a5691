// SPDX-License-Identifier: Apache-2.0
//
// The exact part of the verification: does every point of the hull project into the silhouette?
// Projections come first as doubles with proven errors; only edges that these cannot keep away
// from the silhouette's boundary are projected exactly.
#include "apps/visual_hull/verify/verify_inside.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "apps/visual_hull/polygon/silhouette_index.h"
#include "apps/visual_hull/scene/camera_planes.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {
namespace {

struct Projected {
  enum class State : std::uint8_t { kFront, kApex, kBehind };
  State state = State::kFront;
  std::array<double, 2> at{};
  double error = INFINITY;  ///< of each coordinate
  bool known_inside = false;
};

class InsideCheck {
 public:
  InsideCheck(const nef::Polyhedron& hull, const Camera& camera, const Silhouette& silhouette,
              const nef::Monitor& monitor)
      : hull_(hull),
        complex_(hull.complex()),
        camera_(camera),
        planes_(camera),
        silhouette_(silhouette),
        index_(silhouette),
        monitor_(monitor) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) matrix_[i][j] = nef::nearest_double(camera.matrix()[i][j]);
    }
  }

  /// Empty if the hull projects into the silhouette.
  std::string run() {
    exact_.resize(complex_.vertex_count());
    for (const nef::VertexId v : complex_.vertex_ids()) {
      vertices_.push_back(project(v));
      if (vertices_[v].state == Projected::State::kBehind)
        return "vertex " + std::to_string(v.index()) + " is behind the camera";
    }
    for (const nef::VertexId v : complex_.vertex_ids()) {
      const bool lonely = complex_.vertices[v].svertices == complex_.vertices[v.next()].svertices;
      if (lonely && vertices_[v].state == Projected::State::kFront &&
          index_.locate(exact(v), monitor_) == Side::kOutside) {
        return "vertex " + std::to_string(v.index()) + " projects out of the silhouette";
      }
    }
    for (const nef::HalfedgeId h : complex_.halfedge_ids()) {
      const nef::VertexId a = complex_.source(h);
      const nef::VertexId b = complex_.target(h);
      if (h > complex_.twin[h] || edge_inside(a, b)) continue;
      return "the edge between vertices " + std::to_string(a.index()) + " and " + std::to_string(b.index()) +
             " projects out of the silhouette";
    }
    return covered_hole();
  }

 private:
  Projected project(nef::VertexId v) {
    Projected result;
    const auto& p = complex_.points.approximate(nef::point_of(v));
    std::array<double, 3> x{};
    std::array<double, 3> magnitude{};
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = matrix_[i][3];
      magnitude[i] = std::abs(x[i]);
      for (std::size_t j = 0; j < 3; ++j) {
        x[i] += matrix_[i][j] * p[j];
        magnitude[i] += std::abs(matrix_[i][j] * p[j]);
      }
      // Entries are off by 2^-53, coordinates by 2^-51, a product and three sums by 4 * 2^-53: together
      // below 10 * 2^-53 of the sum of magnitudes; 2^-48 is three times as much.
      magnitude[i] = magnitude[i] * 0x1p-48 + 1e-290;
    }
    if (x[2] > 2 * magnitude[2]) {
      const double least = x[2] - magnitude[2];
      for (std::size_t i = 0; i < 2; ++i) result.at[i] = x[i] / x[2];
      const double largest = std::max(std::abs(result.at[0]), std::abs(result.at[1]));
      const double numerator = std::max(magnitude[0], magnitude[1]);
      result.error = (numerator + magnitude[2] * largest) / least * 1.0001 + largest * 0x1p-51 + 1e-300;
      return result;
    }
    const Rational3 point = complex_.points.rational(nef::point_of(v));
    const Projection exact = camera_.project(point);
    if (sgn(exact.depth) > 0) {
      exact_[v] = Point2(exact.x / exact.depth, exact.y / exact.depth);
      result.at = exact_[v]->approximate;
      result.error = std::max(std::abs(result.at[0]), std::abs(result.at[1])) * 0x1p-52 + 1e-300;
    } else {
      const bool apex = sgn(exact.depth) == 0 && sgn(exact.x) == 0 && sgn(exact.y) == 0;
      result.state = apex ? Projected::State::kApex : Projected::State::kBehind;
    }
    return result;
  }

  const Point2& exact(nef::VertexId v) {
    if (!exact_[v]) {
      const Projection p = camera_.project(complex_.points.rational(nef::point_of(v)));
      exact_[v] = Point2(p.x / p.depth, p.y / p.depth);
    }
    return *exact_[v];
  }

  // True if all of c-d lies surely on one side of the line through a and b, or the other way round.
  static bool surely_apart(const Projected& a, const Projected& b, const Point2& c, const Point2& d) {
    const double error = std::max(a.error, b.error);
    const auto cross = [](const std::array<double, 2>& o, const std::array<double, 2>& p,
                          const std::array<double, 2>& q) {
      return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    };
    double extent = 0;
    double largest = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto [low, high] = std::minmax({a.at[i], b.at[i], c.approximate[i], d.approximate[i]});
      extent = std::max(extent, high - low);
      largest = std::max({largest, std::abs(low), std::abs(high)});
    }
    // Each difference is below `extent` and off by at most e = 2 error + 2^-51 largest: two products of
    // two such differences are off by at most 4 extent e + 2 e^2 and their rounding; nothing may overflow, and what
    // vanishes is a few times 2^-1074.
    if (!(extent < 1e140)) return false;
    const double e = 2 * error + largest * 0x1p-51;
    const double bound = 4 * extent * e + 2 * e * e + extent * extent * 0x1p-50 + 1e-290;
    const double ca = cross(c.approximate, d.approximate, a.at);
    const double cb = cross(c.approximate, d.approximate, b.at);
    if ((ca > bound && cb > bound) || (ca < -bound && cb < -bound)) return true;
    const double ac = cross(a.at, b.at, c.approximate);
    const double ad = cross(a.at, b.at, d.approximate);
    return (ac > bound && ad > bound) || (ac < -bound && ad < -bound);
  }

  bool edge_inside(nef::VertexId va, nef::VertexId vb) {
    Projected& a = vertices_[va];
    Projected& b = vertices_[vb];
    if (a.state != Projected::State::kFront || b.state != Projected::State::kFront) return true;  // seen as a point
    Rectangle box;
    for (const Projected* p : {&a, &b}) {
      box.add({p->at[0] - p->error, p->at[1] - p->error});
      box.add({p->at[0] + p->error, p->at[1] + p->error});
    }
    near_.clear();
    index_.visit_edges(box, [&](const Point2& c, const Point2& d) {
      if (!surely_apart(a, b, c, d)) near_.push_back({&c, &d});
    });
    // Since they come from facets that sides of the silhouette make, most edges near one run along it, or end there.
    for (const auto& [c, d] : near_) {
      const int on_a = place_on_side(va, *c, *d);
      const int on_b = place_on_side(vb, *c, *d);
      if (on_a >= 0 && on_b >= 0) return true;
      const bool alone = near_.size() == 1;
      if (alone && on_a > 0 && side(vb, plane_of(*c, *d)) > 0) return true;
      if (alone && on_b > 0 && side(va, plane_of(*c, *d)) > 0) return true;
    }
    if (!near_.empty()) return edge_inside_exactly(exact(va), exact(vb));
    // Nothing of the boundary is near: all of the edge is where one end is.
    if (!a.known_inside && !b.known_inside && index_.locate(exact(va), monitor_) == Side::kOutside) return false;
    a.known_inside = b.known_inside = true;
    return true;
  }

  // On which side of the line through two points of the image a vertex in front of the camera is seen. Exact.
  int side(nef::VertexId v, const std::array<Integer, 4>& plane) const {
    Integer sum;
    for (std::size_t i = 0; i < 4; ++i) {
      mpz_addmul(sum.get_mpz_t(), plane[i].get_mpz_t(), complex_.points.coordinate(nef::point_of(v), i));
    }
    return sgn(sum);
  }

  // Of the side c-d of the silhouette; positive where the region is.
  const std::array<Integer, 4>& plane_of(const Point2& c, const Point2& d) {
    auto [plane, fresh] = side_planes_.try_emplace(&c);
    if (fresh) plane->second = planes_.through(c, d);
    return plane->second;
  }

  // 1 if a vertex is seen on the side c-d of the silhouette between its ends, 0 at one of them, -1 elsewhere. Exact,
  // without a projection.
  int place_on_side(nef::VertexId v, const Point2& c, const Point2& d) {
    if (side(v, plane_of(c, d)) != 0) return -1;
    const bool steep = std::abs(d.approximate[1] - c.approximate[1]) > std::abs(d.approximate[0] - c.approximate[0]);
    return std::min(beyond_end(v, c, d, steep ? 1 : 0), beyond_end(v, d, c, steep ? 1 : 0));
  }

  // Of a vertex that is seen on the line through two points: 1 on the way from `end` to `other`, or behind that, 0 at
  // `end`, -1 before it. They differ along the axis.
  int beyond_end(nef::VertexId v, const Point2& end, const Point2& other, std::size_t axis) const {
    const Projected& p = vertices_[v];
    const double way = p.at[axis] - end.approximate[axis];
    const double error = p.error + (std::abs(p.at[axis]) + std::abs(end.approximate[axis])) * 0x1p-51;
    if (std::abs(way) > 2 * error) return (way > 0) == (other.approximate[axis] > end.approximate[axis]) ? 1 : -1;
    const Point2 across = axis == 0 ? Point2(end.x(), end.y() + 1) : Point2(end.x() + 1, end.y());
    return side(v, planes_.through(end, across)) * orientation(end, across, other, monitor_);
  }

  bool edge_inside_exactly(const Point2& a, const Point2& b) {
    if (a == b) return index_.locate(a, monitor_) != Side::kOutside;
    std::vector<const Point2*> stops{&a, &b};
    for (const auto& [c, d] : near_) {
      const int sc = orientation(a, b, *c, monitor_);
      const int sd = orientation(a, b, *d, monitor_);
      if (sc * sd > 0) continue;
      const int sa = orientation(*c, *d, a, monitor_);
      const int sb = orientation(*c, *d, b, monitor_);
      if (sa * sb > 0) continue;
      if (sc * sd < 0 && sa * sb < 0) return false;  // one side of each edge is background
      if (sc == 0 && on_segment(a, b, *c, monitor_)) stops.push_back(c);
      if (sd == 0 && on_segment(a, b, *d, monitor_)) stops.push_back(d);
    }
    const std::size_t axis = compare_coordinate(a, b, 0) != 0 ? 0 : 1;
    std::sort(stops.begin(), stops.end(),
              [axis](const Point2* p, const Point2* q) { return compare_coordinate(*p, *q, axis) < 0; });
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const Point2& p = *stops[i];
      const Point2& q = *stops[i + 1];
      if (p == q) continue;
      if (index_.locate(midpoint(p, q), monitor_) == Side::kOutside) return false;
    }
    return true;
  }

  // A point of the background that ring r bounds, found beside one of its edges.
  std::optional<Point2> point_of_hole(std::size_t r) const {
    const Ring& ring = silhouette_.rings[r];
    const auto in_child = [&](const Point2& p) {
      for (std::size_t k = 0; k < silhouette_.rings.size(); ++k) {
        if (silhouette_.parent[k] == static_cast<int>(r) && locate(silhouette_.rings[k], p, monitor_) != Side::kOutside)
          return true;
      }
      return false;
    };
    const Rational half(1, 2);
    Rational step = half;
    for (int k = 0; k < 200; ++k, step *= half) {
      // The background is to the right of the edge: (dx, dy) turned to (dy, -dx).
      const Point2 p((ring[0].x() + ring[1].x()) / 2 + step * (ring[1].y() - ring[0].y()),
                     (ring[0].y() + ring[1].y()) / 2 - step * (ring[1].x() - ring[0].x()));
      if (locate(ring, p, monitor_) == Side::kInside && !in_child(p)) return p;
    }
    return std::nullopt;
  }

  // Where a line of sight begins: the centre, or a point before the hull.
  Rational3 start_of(const Point2& point) const {
    if (!camera_.is_parallel()) return camera_.centre();
    Rational nearest;
    bool first = true;
    for (const nef::VertexId v : complex_.vertex_ids()) {
      const Rational depth = camera_.depth(complex_.points.rational(nef::point_of(v)));
      if (first || depth < nearest) nearest = depth;
      first = false;
    }
    return camera_.sight_point(point, nearest - 1);
  }

  std::string covered_hole() const {
    for (std::size_t r = 0; r < silhouette_.rings.size(); ++r) {
      if (silhouette_.depth[r] % 2 == 0) continue;
      const std::optional<Point2> point = point_of_hole(r);
      if (!point) continue;  // 200 halvings do not fail on a ring with area
      if (nef::shoot_ray(hull_, start_of(*point), camera_.ray(*point), {}, monitor_)) {
        return "hole " + std::to_string(r + 1) + " of the silhouette is covered by the hull";
      }
    }
    return {};
  }

  const nef::Polyhedron& hull_;
  const nef::Complex& complex_;
  const Camera& camera_;
  const CameraPlanes planes_;
  const Silhouette& silhouette_;
  SilhouetteIndex index_;
  nef::Monitor monitor_;
  std::array<std::array<double, 4>, 3> matrix_{};
  nef::IndexedVector<nef::VertexId, Projected> vertices_;
  nef::IndexedVector<nef::VertexId, std::optional<Point2>> exact_;
  std::vector<std::array<const Point2*, 2>> near_;
  std::unordered_map<const Point2*, std::array<Integer, 4>> side_planes_;  // by the points in which sides begin
};

}  // namespace

std::string why_outside(const nef::Polyhedron& hull, const Camera& camera, const Silhouette& silhouette,
                        const nef::Monitor& monitor) {
  return InsideCheck(hull, camera, silhouette, monitor).run();
}

}  // namespace nef::visual_hull
