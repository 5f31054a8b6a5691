// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/triangle_pull.h"

#include <algorithm>
#include <optional>

#include "apps/planner/free_space/vectors.h"
#include "nef/geometry/box_tree.h"

namespace nef::planner {
namespace {

Rational3 minus(const Rational3& a, const Rational3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Rational3& a, const Rational3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Rational3 cross(const Rational3& a, const Rational3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Corner b of the triangle a, b, c in coordinates (u, v) with x = a + u (c - a) + v (b - a).
class Triangle {
 public:
  Triangle(const Rational3& a, const Rational3& b, const Rational3& c) : a_(a), ac_(minus(c, a)), ab_(minus(b, a)) {
    normal_ = cross(ac_, ab_);
    size_ = dot(normal_, normal_);
    for (const Rational3* p : {&a, &b, &c}) {
      box_.add_rounded(to_array(to_vector(*p)));
    }
  }
  [[nodiscard]] bool flat() const { return size_ == 0; }
  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] Rational height(const Rational3& x) const { return dot(normal_, minus(x, a_)); }

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
  Box box_;
};

using Point2 = std::array<Rational, 2>;

// The points in which edges meet the triangle.
std::vector<Point2> meetings(const FreeSpace& free, const Triangle& triangle) {
  const Complex& c = free.complex();
  std::vector<Point2> result;
  const auto add = [&](const Rational3& x) {
    if (const std::optional<Point2> uv = triangle.inside(x)) result.push_back(*uv);
  };
  for (std::uint32_t h = 0; h < c.svertices.size(); ++h) {
    if (c.twin[h] < h) continue;
    const PointId p{c.svertex_owner[h]};
    const PointId q{c.target(h)};
    Box box;
    box.add_rounded(c.points.approximate(p));
    box.add_rounded(c.points.approximate(q));
    if (!box.overlaps(triangle.box())) continue;
    const Rational3 x = c.points.rational(p);
    const Rational3 y = c.points.rational(q);
    const Rational hx = triangle.height(x);
    const Rational hy = triangle.height(y);
    if (hx == 0) add(x);
    if (hy == 0) add(y);
    if (sgn(hx) * sgn(hy) >= 0) continue;
    const Rational t = hx / (hx - hy);
    add({x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1]), x[2] + t * (y[2] - x[2])});
  }
  return result;
}

// The upper hull from (0,0) to (1,0), ends included, by the monotone chain of [Andrew 1979]: the boundary of the convex
// hull of all points without the side between the two. The triangle's corner is (0,1), so points may share u = 0 with
// the first end and be above it, but nothing is left of it.
std::vector<Point2> taut_string(std::vector<Point2> points) {
  std::erase_if(points, [](const Point2& p) { return p[1] == 0; });
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  points.insert(points.begin(), {0, 0});
  points.push_back({1, 0});
  std::vector<Point2> hull;
  for (const Point2& p : points) {
    while (hull.size() >= 2) {
      const Point2& a = hull[hull.size() - 2];
      const Point2& b = hull.back();
      const Rational turn = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
      if (turn < 0) break;
      hull.pop_back();
    }
    hull.push_back(p);
  }
  return hull;
}

}  // namespace

bool pull_corner(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t i) {
  if (segment_allowed(free, filter, path[i - 1], path[i + 1])) {
    path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
  }
  const Triangle triangle(path[i - 1], path[i], path[i + 1]);
  if (triangle.flat()) return false;
  std::vector<Point2> hits = meetings(free, triangle);
  const Point2 corner{0, 1};
  // A string over the corner itself is the path as it is.
  if (std::find(hits.begin(), hits.end(), corner) != hits.end()) return false;
  const std::vector<Point2> hull = taut_string(std::move(hits));
  Waypoints string;
  for (const Point2& p : hull) string.push_back(triangle.at(p));
  const double before = distance(path[i - 1], path[i]) + distance(path[i], path[i + 1]);
  if (!(length_of(string) < before - 1e-13 * before)) return false;
  for (std::size_t k = 0; k + 1 < string.size(); ++k) {
    if (!segment_allowed(free, filter, string[k], string[k + 1])) return false;
  }
  path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
  path.insert(path.begin() + static_cast<std::ptrdiff_t>(i), string.begin() + 1, string.end() - 1);
  return true;
}

}  // namespace nef::planner
