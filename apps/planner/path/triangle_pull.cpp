// SPDX-License-Identifier: Apache-2.0
//
// Coordinates (u, v) in the plane of the triangle put the two neighbours at (0, 0) and (1, 0) and the way-point at (0,
// 1). The edges near the triangle (a search in the tree of items) are intersected with it; the upper hull of these
// points is the taut string. Doubles drop points that are surely below a hull of all; only the rest is computed
// exactly.
#include "apps/planner/path/shorten.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "apps/planner/intersection/vectors.h"
#include "nef/geometry/monotone_chain.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

// Doubles take points that are so near, as a share of the triangle, for the same.
constexpr double kNear = 1e-9;

using Point2 = std::array<Rational, 2>;

// Corner b of the triangle a, b, c in coordinates (u, v) with x = a + u (c - a) + v (b - a).
class Triangle {
 public:
  Triangle(const Rational3& a, const Rational3& b, const Rational3& c) : a_(a), ac_(minus(c, a)), ab_(minus(b, a)) {
    normal_ = cross(ac_, ab_);
    size_ = dot(normal_, normal_);
    approximate_normal_ = to_vector(normal_);
    if (size_ != 0) direction_ = direction_of(normal_);
    approximate_a_ = to_vector(a_);
    approximate_ab_ = to_vector(ab_);
    approximate_ac_ = to_vector(ac_);
    for (const Rational3* p : {&a, &b, &c}) {
      box_.add_rounded(to_array(to_vector(*p)));
    }
  }
  [[nodiscard]] bool flat() const { return size_ == 0; }
  /// True if the box may meet the triangle: its box and its plane. u = 2^-53; of `size` a component of the direction is
  /// off by 4u, a coordinate by u, the middle of two and the difference to a by 2u, products by u, three sums by 3u,
  /// and `reach` by as much: less than 2^-48. What is tiny is off by 2^-1074.
  [[nodiscard]] bool may_meet(const Box& box) const {
    if (!box.overlaps(box_)) return false;
    double value = 0;
    double reach = 0;
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double n = direction_[static_cast<Eigen::Index>(k)];
      const double a = approximate_a_[static_cast<Eigen::Index>(k)];
      value += n * ((box.low[k] + box.high[k]) / 2 - a);
      reach += std::fabs(n) * (box.high[k] - box.low[k]) / 2;
      size += std::fabs(n) * (std::fabs(box.low[k]) + std::fabs(box.high[k]) + std::fabs(a));
    }
    return !(std::fabs(value) > reach + 0x1p-44 * size + 1e-300);
  }
  [[nodiscard]] Rational height(const Rational3& x) const { return dot(normal_, minus(x, a_)); }

  /// How far a segment from x to y is from meeting the triangle, and where it meets it, as doubles see it. They may:
  /// what they overlook is not tried.
  struct Meeting {
    enum class Kind : std::uint8_t { kNone, kPoint, kAlong } kind = Kind::kNone;
    std::array<double, 2> at{};  ///< the point (u, v)
  };
  [[nodiscard]] Meeting meeting(const Vector3d& x, const Vector3d& y) const {
    const Vector3d& ab = approximate_ab_;
    const Vector3d& ac = approximate_ac_;
    const Vector3d ax = x - approximate_a_;
    const Vector3d along = y - x;
    const double size = approximate_normal_.squaredNorm();
    const double hx = approximate_normal_.dot(ax);
    const double hy = approximate_normal_.dot(ax + along);
    const double flat = kNear * std::sqrt(size) * (ab.norm() + ac.norm());
    if (std::min(hx, hy) > flat || std::max(hx, hy) < -flat) return {};
    if (std::fabs(hx - hy) <= 4 * flat) return {Meeting::Kind::kAlong, {}};
    const Vector3d at = ax + hx / (hx - hy) * along;
    const double u = at.cross(ab).dot(approximate_normal_) / size;
    const double v = ac.cross(at).dot(approximate_normal_) / size;
    if (!(u >= -kNear && v >= -kNear && u + v <= 1 + kNear)) return {};
    return {Meeting::Kind::kPoint, {u, v}};
  }

  /// Coordinates of a point of the plane, if it lies in the closed triangle.
  [[nodiscard]] std::optional<std::array<Rational, 2>> inside(const Rational3& x) const {
    const Rational3 ax = minus(x, a_);
    const Rational u = dot(cross(ax, ab_), normal_) / size_;
    const Rational v = dot(cross(ac_, ax), normal_) / size_;
    if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
    return std::array<Rational, 2>{u, v};
  }
  [[nodiscard]] Rational3 at(const std::array<Rational, 2>& uv) const {
    Rational3 x = a_;
    for (std::size_t i = 0; i < 3; ++i) x[i] += uv[0] * ac_[i] + uv[1] * ab_[i];
    return x;
  }

 private:
  Rational3 a_;
  Rational3 ac_;
  Rational3 ab_;
  Rational3 normal_;
  Rational size_;
  Vector3d approximate_normal_;
  Vector3d direction_ = Vector3d::Zero();  // the normal with length 1
  Vector3d approximate_a_;
  Vector3d approximate_ab_;
  Vector3d approximate_ac_;
  Box box_;
};

// The upper hull from (0,0) to (1,0), ends included, by the monotone chain of [Andrew 1979]: the boundary of the convex
// hull of all points without the side between the two. The triangle's corner is (0,1), so points may share u = 0 with
// the first end and be above it, but nothing is left of it.
template <typename Number>
std::vector<std::array<Number, 2>> taut_string(std::vector<std::array<Number, 2>> points) {
  using Point = std::array<Number, 2>;
  std::erase_if(points, [](const Point& p) { return p[1] <= 0; });
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  points.insert(points.begin(), Point{0, 0});
  points.push_back(Point{1, 0});
  const auto right_turn = [](const Point& a, const Point& b, const Point& c) {
    const Number turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return turn < 0;
  };
  std::vector<Point> hull;
  append_hull_chain(std::span<const Point>(points), right_turn, hull);
  return hull;
}

// The height of a hull at u.
double height_at(const std::vector<std::array<double, 2>>& hull, double u) {
  double height = 0;
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const std::array<double, 2>& a = hull[i];
    const std::array<double, 2>& b = hull[i + 1];
    if (u < a[0] || u > b[0]) continue;
    const double at = b[0] > a[0] ? a[1] + (u - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) : std::max(a[1], b[1]);
    height = std::max(height, at);
  }
  return height;
}

// The edges near the triangle, by one of their halfedges.
std::vector<HalfedgeId> edges_near(const FreeSpace& free, const Triangle& triangle) {
  const Complex& c = free.complex();
  std::vector<HalfedgeId> edges;
  const auto add = [&](HalfedgeId h) {
    Box box;
    box.add_rounded(c.points.approximate(point_of(c.source(h))));
    box.add_rounded(c.points.approximate(point_of(c.target(h))));
    if (triangle.may_meet(box)) edges.push_back(c.edge(h));
  };
  free.items().for_each_if([&](const Box& box) { return triangle.may_meet(box); },
                           [&](const ItemRef& item) {
                             if (item.kind == ItemRef::Kind::kEdge) add(item.halfedge());
                             if (item.kind != ItemRef::Kind::kFacet) return;
                             for (const SHalfedgeId corner : c.corners_of(item.facet())) {
                               add(c.corner_halfedge(corner));
                             }
                           });
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

// The points in which an edge meets the triangle, exactly.
void append_meetings(const Complex& c, HalfedgeId halfedge, const Triangle& triangle, std::vector<Point2>& points) {
  const auto add = [&](const Rational3& x) {
    if (const std::optional<Point2> uv = triangle.inside(x)) points.push_back(*uv);
  };
  const Rational3 x = c.points.rational(point_of(c.source(halfedge)));
  const Rational3 y = c.points.rational(point_of(c.target(halfedge)));
  const Rational hx = triangle.height(x);
  const Rational hy = triangle.height(y);
  if (hx == 0) add(x);
  if (hy == 0) add(y);
  if (sgn(hx) * sgn(hy) >= 0) return;
  add(point_between(x, y, hx / (hx - hy)));
}

// The points in which edges meet the triangle, but for those that are well below a string over all of them.
std::vector<Point2> upper_meetings(const FreeSpace& free, const Triangle& triangle) {
  using Meeting = Triangle::Meeting;
  const Complex& c = free.complex();
  std::vector<std::pair<HalfedgeId, Meeting>> met;
  std::vector<std::array<double, 2>> rough;
  for (const HalfedgeId h : edges_near(free, triangle)) {
    const Meeting meeting = triangle.meeting(to_vector(c.points.approximate(point_of(c.source(h)))),
                                             to_vector(c.points.approximate(point_of(c.target(h)))));
    if (meeting.kind == Meeting::Kind::kNone) continue;
    met.emplace_back(h, meeting);
    if (meeting.kind == Meeting::Kind::kPoint) rough.push_back(meeting.at);
  }
  const std::vector<std::array<double, 2>> hull = taut_string(std::move(rough));
  std::vector<Point2> result;
  for (const auto& [h, meeting] : met) {
    const bool matters =
        meeting.kind == Meeting::Kind::kAlong || meeting.at[1] >= height_at(hull, meeting.at[0]) - 2 * kNear;
    if (matters) append_meetings(c, h, triangle, result);
  }
  return result;
}

// A point with small numbers not far from x, beside coordinates as large as `reach`.
Rational3 rounded(const Rational3& x, double reach) {
  constexpr int kBits = 30;
  const double unit = std::ldexp(1.0, std::ilogb(reach) - kBits);
  Rational3 result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = exact_rational(std::nearbyint(nearest_double(x[k]) / unit) * unit);
  return result;
}

// Where the edges may not be touched: the string drawn larger about the middle of the triangle's base, which leaves
// all of it beyond the edges, and its way-points rounded. If a string so near is not free, nothing is: what lies
// between it and the corner contains no edge.
std::optional<Waypoints> string_beside_edges(const FreeSpace& free, const CellFilter& filter, const Triangle& triangle,
                                             const std::vector<Point2>& hull) {
  const Rational middle(1, 2);
  for (const int bits : {18, 10}) {
    const Rational growth = 1 + exact_rational(std::ldexp(1.0, -bits));
    Waypoints string;
    for (const Point2& p : hull) {
      const bool end = p == hull.front() || p == hull.back();
      string.push_back(triangle.at(end ? p : Point2{middle + growth * (p[0] - middle), growth * p[1]}));
    }
    Waypoints simple = string;
    double reach = 0;
    for (const Rational3& x : string) reach = std::max(reach, to_vector(x).lpNorm<Eigen::Infinity>());
    for (std::size_t k = 1; k + 1 < simple.size(); ++k) simple[k] = rounded(simple[k], reach);
    if (way_allowed(free, filter, simple)) return simple;
    if (way_allowed(free, filter, string)) return string;
  }
  return std::nullopt;
}

}  // namespace

bool pull_corner(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t i) {
  if (segment_allowed(free, filter, path[i - 1], path[i + 1])) {
    path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
  }
  const Triangle triangle(path[i - 1], path[i], path[i + 1]);
  if (triangle.flat()) return false;
  std::vector<Point2> hits = upper_meetings(free, triangle);
  const Point2 corner{0, 1};
  // A string over the corner itself is the path as it is.
  if (std::find(hits.begin(), hits.end(), corner) != hits.end()) return false;
  const std::vector<Point2> hull = taut_string(std::move(hits));
  Waypoints string;
  for (const Point2& p : hull) string.push_back(triangle.at(p));
  const double before = distance(path[i - 1], path[i]) + distance(path[i], path[i + 1]);
  if (!(length_of(string) < before - 1e-13 * before)) return false;
  if (!way_allowed(free, filter, string)) {
    // What a string beside the edges gains again and again by coming nearer is not worth its numbers.
    constexpr double kGain = 1e-7;
    std::optional<Waypoints> beside = string_beside_edges(free, filter, triangle, hull);
    if (!beside || !(length_of(*beside) < before - kGain * before)) return false;
    string = std::move(*beside);
  }
  path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
  path.insert(path.begin() + static_cast<std::ptrdiff_t>(i), string.begin() + 1, string.end() - 1);
  return true;
}

}  // namespace nef::planner
