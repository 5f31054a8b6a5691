// SPDX-License-Identifier: Apache-2.0
//
// Exact polygons with holes in an image plane: what a silhouette is.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/number/number.h"

namespace nef::visual_hull {

using nef::Integer;
using nef::Rational;
using nef::Rational3;

/// A point of an image plane: u to the right, v down. Coordinates that are doubles take no other memory.
struct Point2 {
  std::array<double, 2> approximate{};  ///< nearest doubles
  bool lattice = true;                  ///< both are multiples of 2^-8 below 2^16: determinants of doubles are exact

  Point2() = default;  ///< the origin
  Point2(const Rational& x, const Rational& y);
  /// A point whose coordinates are doubles, taken as the numbers that they are. Throws InputError unless finite.
  static Point2 from_doubles(double x, double y);

  [[nodiscard]] Rational x() const { return coordinate(0); }
  [[nodiscard]] Rational y() const { return coordinate(1); }
  [[nodiscard]] Rational coordinate(std::size_t axis) const;
  /// True if `approximate` is the point itself.
  [[nodiscard]] bool is_double() const { return exact_ == nullptr; }

  bool operator==(const Point2& other) const;

 private:
  std::shared_ptr<const std::array<Rational, 2>> exact_;  // where the doubles are not
};

/// -1, 0 or 1: the order of two coordinates. Exact; O(1) where they differ as doubles or are doubles.
int compare_coordinate(const Point2& a, const Point2& b, std::size_t axis);

/// Lexicographic order, by x first. Exact.
bool lexicographically_less(const Point2& a, const Point2& b);

/// Exact.
Point2 midpoint(const Point2& a, const Point2& b);

/// sign((b - a) x (c - a)): +1 if c lies to the left of the ray from a through b in (u, v)
/// algebra (on a screen, where v points down, that is clockwise). Exact; double filter first.
int orientation(const Point2& a, const Point2& b, const Point2& c, const nef::Monitor& monitor = {});

/// True if p lies on the closed segment ab. Exact.
bool on_segment(const Point2& a, const Point2& b, const Point2& p, const nef::Monitor& monitor = {});

/// True if the closed segments ab and cd have a point in common. Exact.
bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d, const nef::Monitor& monitor);

/// A cycle of vertices without repetition of the first.
using Ring = std::vector<Point2>;

/// The sign of the signed area of a simple ring: +1 if its inside is to the left. Exact.
int ring_orientation(const Ring& ring, const nef::Monitor& monitor = {});

/// Twice the signed area, in double precision: for sorting and reports, never for a decision.
double twice_area(const Ring& ring);

enum class Side { kInside, kBoundary, kOutside };

/// Where a point lies with respect to a simple ring (of either orientation). Exact, O(n).
Side locate(const Ring& ring, const Point2& point, const nef::Monitor& monitor = {});

/// A closed region: rings are simple, have at most vertices in common, and are oriented so that
/// the region lies to their left; nested by parity (outer, hole, island in a hole, ...).
struct Silhouette {
  std::vector<Ring> rings;
  std::vector<int> parent;  ///< the ring directly around it, -1 for none
  std::vector<int> depth;   ///< 0 outer, 1 hole, 2 island, ...

  [[nodiscard]] std::size_t vertex_count() const;
  [[nodiscard]] std::size_t hole_count() const;
  [[nodiscard]] bool empty() const { return rings.empty(); }
};

/// Where a point lies with respect to the closed region. Exact, O(n).
Side locate(const Silhouette& silhouette, const Point2& point, const nef::Monitor& monitor = {});

/// Nests and orients rings that are known to be simple and to meet in vertices only.
/// O(rings^2 + vertices * nesting depth).
Silhouette nest(std::vector<Ring> rings, const nef::Monitor& monitor);

/// The same for rings from outside, combined by parity: repeated and collinear vertices are
/// dropped, an edge is split where a vertex of another ring touches it. Throws InputError, with
/// `where` in front, if a ring has no area, crosses itself or another, or shares a piece of an edge.
Silhouette make_silhouette(std::vector<Ring> rings, const std::string& where, const nef::Monitor& monitor = {});

/// The first pair of edges that meet in more than a common vertex, or vertex that a ring comes to twice, in words;
/// empty if there is none. Exact. O(n log n) on ordinary input.
std::string first_crossing(const std::vector<Ring>& rings, const nef::Monitor& monitor);

/// The empty string if the silhouette holds what its type promises, otherwise the first thing
/// that is wrong. O(n log n) on ordinary input.
std::string check(const Silhouette& silhouette, const nef::Monitor& monitor = {});

}  // namespace nef::visual_hull
