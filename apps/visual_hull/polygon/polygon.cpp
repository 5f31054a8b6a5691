// SPDX-License-Identifier: Apache-2.0
//
// Exact predicates on points, segments and rings of an image plane. Pixel coordinates are short enough that
// determinants of doubles are exact (`lattice`); for other points, doubles decide if the value exceeds a proven bound
// of its error, and rationals if not. Where rounding to the nearest double keeps order, comparisons of doubles that
// differ decide.
#include "apps/visual_hull/polygon/polygon.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/base/fast_path.h"
#include "nef/number/approximation.h"

namespace nef::visual_hull {
namespace {

// v == k 2^-8 and |v| < 2^16: 24 bits, so differences have 25 and products 50.
bool is_lattice(double v) { return std::abs(v) < 65536.0 && v * 256 == std::floor(v * 256); }

// GMP's comparisons are of any size.
int sign_of(int order) { return (order > 0) - (order < 0); }

int exact_orientation(const Point2& a, const Point2& b, const Point2& c) {
  const Rational left = (b.x() - a.x()) * (c.y() - a.y());
  const Rational right = (b.y() - a.y()) * (c.x() - a.x());
  return sign_of(cmp(left, right));
}

}  // namespace

Point2::Point2(const Rational& x, const Rational& y) : approximate{nef::nearest_double(x), nef::nearest_double(y)} {
  const bool finite = std::isfinite(approximate[0]) && std::isfinite(approximate[1]);
  if (finite && x == approximate[0] && y == approximate[1]) {
    lattice = is_lattice(approximate[0]) && is_lattice(approximate[1]);
  } else {
    lattice = false;
    exact_ = std::make_shared<const std::array<Rational, 2>>(std::array{x, y});
  }
}

Point2 Point2::from_doubles(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) throw nef::InputError("a coordinate is not a finite number");
  Point2 point;
  point.approximate = {x, y};
  point.lattice = is_lattice(x) && is_lattice(y);
  return point;
}

Rational Point2::coordinate(std::size_t axis) const {
  return exact_ != nullptr ? (*exact_)[axis] : Rational(approximate[axis]);
}

bool Point2::operator==(const Point2& other) const {
  if (approximate != other.approximate || is_double() != other.is_double()) return false;
  return is_double() || *exact_ == *other.exact_;
}

// Rounding to nearest is monotone, so doubles that differ decide.
int compare_coordinate(const Point2& a, const Point2& b, std::size_t axis) {
  if (a.approximate[axis] != b.approximate[axis]) return a.approximate[axis] < b.approximate[axis] ? -1 : 1;
  if (a.is_double() && b.is_double()) return 0;
  return sign_of(cmp(a.coordinate(axis), b.coordinate(axis)));
}

bool lexicographically_less(const Point2& a, const Point2& b) {
  const int order = compare_coordinate(a, b, 0);
  return order != 0 ? order < 0 : compare_coordinate(a, b, 1) < 0;
}

Point2 midpoint(const Point2& a, const Point2& b) {
  if (a.lattice && b.lattice) {  // 25 bits
    return Point2::from_doubles((a.approximate[0] + b.approximate[0]) / 2, (a.approximate[1] + b.approximate[1]) / 2);
  }
  return {(a.x() + b.x()) / 2, (a.y() + b.y()) / 2};
}

int orientation(const Point2& a, const Point2& b, const Point2& c, const nef::Monitor& monitor) {
  const double bx = b.approximate[0] - a.approximate[0];
  const double by = b.approximate[1] - a.approximate[1];
  const double cx = c.approximate[0] - a.approximate[0];
  const double cy = c.approximate[1] - a.approximate[1];
  const double left = bx * cy;
  const double right = by * cx;
  const double determinant = left - right;
  if (nef::kFastPaths && a.lattice && b.lattice && c.lattice) return determinant > 0 ? 1 : (determinant < 0 ? -1 : 0);
  // Every coordinate is off by at most u|x| (u = 2^-53), so a difference of two by at most
  // 3u(|x| + |y|) with its own rounding. With m the largest |coordinate| that is 6um, and each
  // factor is at most 2m(1 + 2u): a product is off by at most 2 * 6um * 2m + u * 4m^2 < 29um^2,
  // the determinant by twice that and its rounding, < 72um^2 < 2^-46 m^2.
  double largest = 0;
  for (const Point2* p : {&a, &b, &c}) {
    largest = std::max({largest, std::abs(p->approximate[0]), std::abs(p->approximate[1])});
  }
  const bool moderate = largest > 1e-140 && largest < 1e140;
  return nef::sign_by_ladder({determinant, moderate ? 0x1p-46 * largest * largest : HUGE_VAL}, monitor,
                             [&] { return exact_orientation(a, b, c); });
}

namespace {

// a <= p <= b or b <= p <= a in both coordinates.
bool in_rectangle(const Point2& a, const Point2& b, const Point2& p) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (compare_coordinate(a, p, axis) * compare_coordinate(b, p, axis) > 0) return false;
  }
  return true;
}

}  // namespace

bool on_segment(const Point2& a, const Point2& b, const Point2& p, const nef::Monitor& monitor) {
  return in_rectangle(a, b, p) && orientation(a, b, p, monitor) == 0;
}

bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d, const nef::Monitor& monitor) {
  for (std::size_t i = 0; i < 2; ++i) {  // monotone rounding: disjoint doubles are disjoint truths
    if (std::max(a.approximate[i], b.approximate[i]) < std::min(c.approximate[i], d.approximate[i])) return false;
    if (std::max(c.approximate[i], d.approximate[i]) < std::min(a.approximate[i], b.approximate[i])) return false;
  }
  const int abc = orientation(a, b, c, monitor);
  const int abd = orientation(a, b, d, monitor);
  if (abc * abd > 0) return false;
  const int cda = orientation(c, d, a, monitor);
  const int cdb = orientation(c, d, b, monitor);
  if (cda * cdb > 0) return false;
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && in_rectangle(a, b, c)) || (abd == 0 && in_rectangle(a, b, d)) ||
         (cda == 0 && in_rectangle(c, d, a)) || (cdb == 0 && in_rectangle(c, d, b));
}

int ring_orientation(const Ring& ring, const nef::Monitor& monitor) {
  const std::size_t n = ring.size();
  if (n < 3) return 0;
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (lexicographically_less(ring[i], ring[lowest])) lowest = i;
  }
  // At a lexicographic extreme the turn is the ring's, unless it is straight or a spike.
  return orientation(ring[(lowest + n - 1) % n], ring[lowest], ring[(lowest + 1) % n], monitor);
}

double twice_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& p = ring[i].approximate;
    const auto& q = ring[(i + 1) % ring.size()].approximate;
    sum += p[0] * q[1] - p[1] * q[0];
  }
  return sum;
}

Side locate(const Ring& ring, const Point2& point, const nef::Monitor& monitor) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2& a = ring[i];
    const Point2& b = ring[i + 1 < ring.size() ? i + 1 : 0];
    const int ya = compare_coordinate(a, point, 1);
    const int yb = compare_coordinate(b, point, 1);
    if (ya * yb > 0) continue;
    if (on_segment(a, b, point, monitor)) return Side::kBoundary;
    if ((ya > 0) == (yb > 0)) continue;  // half-open rule: a vertex on the ray belongs to what is above
    const int turn = orientation(a, b, point, monitor);
    if ((yb > 0) == (turn > 0)) inside = !inside;
  }
  return inside ? Side::kInside : Side::kOutside;
}

Side locate(const Silhouette& silhouette, const Point2& point, const nef::Monitor& monitor) {
  bool inside = false;
  for (const Ring& ring : silhouette.rings) {
    const Side side = locate(ring, point, monitor);
    if (side == Side::kBoundary) return side;
    if (side == Side::kInside) inside = !inside;
  }
  return inside ? Side::kInside : Side::kOutside;
}

}  // namespace nef::visual_hull
