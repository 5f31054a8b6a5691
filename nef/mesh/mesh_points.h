// SPDX-License-Identifier: Apache-2.0
//
// Exact predicates on the points of a mesh, by index: a double filter, then integers of two words where a
// small common denominator exists (decimal files) or homogeneous coordinates are below 2^62, then GMP.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/geometry/box_tree.h"
#include "nef/geometry/point_table.h"
#include "nef/number/approximation.h"
#include "nef/number/int128.h"
#include "nef/number/number.h"

namespace nef {

/// An immutable set of finite points that answers questions about their positions. All answers are exact.
class MeshPoints {
 public:
  /// Copies what it needs. O(n).
  explicit MeshPoints(std::span<const Rational3> points);
  /// The same for points that a table holds; all must be finite.
  explicit MeshPoints(PointTable points);
  /// The same for some points of a table, which must be finite; they get numbers in this order. Small
  /// integers are read without GMP.
  MeshPoints(const PointTable& points, std::span<const PointId> chosen);

  [[nodiscard]] std::size_t size() const { return approximate_.size(); }

  /// The sign of det(b - a, c - a, d - a): +1 if a, b, c turn counterclockwise as seen from d's side.
  [[nodiscard]] int orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;

  /// det(b - a, c - a, d - a) in the scaled space of approximate(). Its sign, if it tells one, is that of
  /// orientation(), and much cheaper where points are in one plane, or all but. Tells nothing if the points are not
  /// moderate.
  [[nodiscard]] Approximation determinant(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;

  /// The sign of component `axis` of (b - a) x (c - a): orientation of the three points in the projection along
  /// that axis.
  [[nodiscard]] int orientation_along(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) const;

  /// The same for each axis if doubles can tell, and 0 where they can not.
  [[nodiscard]] std::array<std::int8_t, 3> filtered_turns(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  /// True if the three points lie on one line.
  [[nodiscard]] bool collinear(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  /// True if all of `others` lie in the plane of a, b and c, which are not on one line.
  [[nodiscard]] bool coplanar(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                              std::span<const std::uint32_t> others) const;

  /// An axis along which the three points, not collinear, do not project to one line; usually the one along which
  /// their triangle looks largest.
  [[nodiscard]] std::size_t projection_axis(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  /// The sign of a[axis] - b[axis].
  [[nodiscard]] int compare(std::uint32_t a, std::uint32_t b, std::size_t axis) const;
  /// Lexicographic comparison.
  [[nodiscard]] int compare(std::uint32_t a, std::uint32_t b) const;

  /// The integers x D, y D, z D of a point for one denominator D of all points, where these are below 2^40; empty if
  /// they are not.
  [[nodiscard]] std::span<const std::array<std::int64_t, 3>> integers() const { return integers_; }
  [[nodiscard]] std::int64_t denominator() const { return denominator_; }

  /// The points as a table with the same numbers, where there are no small integers; empty if there are, and for chosen
  /// points of another table.
  [[nodiscard]] const PointTable& table() const { return table_; }

  /// Coordinates in a space that is scaled by one positive factor, each within margin(axis) of the truth.
  [[nodiscard]] const std::array<double, 3>& approximate(std::uint32_t p) const { return approximate_[p]; }
  [[nodiscard]] double margin(std::size_t axis) const { return margin_[axis]; }

  /// True if these are below 1e100, so that products of three do not overflow.
  [[nodiscard]] bool moderate() const { return filter_; }

  /// Encloses the point, in the same scaled space.
  void extend(Box& box, std::uint32_t p) const;

 private:
  class PlaneThrough;

  bool make_integers(std::span<const Rational3> points);
  bool make_integers(const PointTable& points, std::span<const PointId> chosen);
  bool read_homogeneous(const PointTable& points, std::span<const PointId> chosen);
  bool find_denominator();
  bool make_integers_of_homogeneous();
  bool enlarge_denominator(std::int64_t factor);
  bool no_integers();
  void approximate_integers();
  void find_margins(bool exact);
  [[nodiscard]] Int128 short_difference(std::uint32_t a, std::uint32_t b, std::size_t axis) const;
  void difference(std::uint32_t a, std::uint32_t b, std::span<Integer> out, std::size_t first = 0) const;
  [[nodiscard]] int orientation_exact(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;
  // Of (b - a) x (c - a), in the scaled space. Nothing if the points are not moderate.
  [[nodiscard]] Approximation component(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) const;
  [[nodiscard]] int orientation_along_exact(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t axis) const;

  std::vector<std::array<double, 3>> approximate_;
  std::int64_t denominator_ = 1;
  std::vector<std::array<std::int64_t, 3>> integers_;     // scaled coordinates below 2^40; empty if there are none
  std::vector<std::array<std::int64_t, 4>> homogeneous_;  // below 2^62, if there are none and all are such
  PointTable table_;                                      // filled only where these are not
  std::array<double, 3> margin_{};
  bool filter_ = true;
};

}  // namespace nef
