// SPDX-License-Identifier: Apache-2.0
//
// Exact points in flat arrays.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "nef/geometry/ids.h"
#include "nef/geometry/plane_table.h"
#include "nef/geometry/rows/point_rows.h"

namespace nef {

/// Points with exact homogeneous coordinates (x + x'R, y + y'R, z + z'R) / w, w > 0, and a cached
/// double for each coordinate, within 2^-51 relative of the truth (infinite where the factor of R
/// is not zero). The same point may be held more than once.
class PointTable {
 public:
  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  /// Appends the point with the given finite coordinates.
  PointId push(const Rational3& point);

  /// Appends the point of homogeneous coordinates x, y, z, w (not zero), x', y', z'.
  PointId push_homogeneous(std::array<Integer, 7>& coordinates);
  /// The same in integers of two words; w > 0.
  PointId push_homogeneous(const std::array<Int128, 7>& coordinates);

  /// Appends a copy of a point of another table.
  PointId push_from(const PointTable& other, PointId point);

  /// The same with coordinates without common factor: equal points become identical ones.
  PointId push_reduced(const PointTable& other, PointId point);

  /// True if the coordinates of a point have no common factor. `divisor` becomes theirs.
  [[nodiscard]] bool is_reduced(PointId point, Integer& divisor) const;

  /// Appends `count` consecutive points of another table, from point `first` on.
  void append(const PointTable& other, std::size_t first, std::size_t count);

  /// Appends the point where three planes meet; nothing if their normals are linearly dependent.
  /// At most one determinant and three more; about a microsecond on ordinary input.
  std::optional<PointId> push_intersection(const PlaneTable& planes, PlaneId p, PlaneId q, PlaneId r);

  /// Takes the last point off again.
  void pop() { rows_.pop(); }

  /// Homogeneous coordinate: 0..2 for x, y, z; 3 for w; 4..6 for the factors of R.
  [[nodiscard]] IntegerView coordinate(PointId point, std::size_t column) const {
    return rows_.at(point.index(), column);
  }

  /// The homogeneous coordinates x, y, z, w.
  [[nodiscard]] std::array<IntegerView, 4> coordinates(PointId point) const { return rows_.coordinates(point.index()); }

  /// All seven homogeneous coordinates, if they are below 2^62 in magnitude; else false.
  [[nodiscard]] bool small_coordinates(PointId point, std::array<std::int64_t, 7>& out) const {
    return rows_.read_small(point.index(), out);
  }

  /// The three doubles of a point.
  [[nodiscard]] const std::array<double, 3>& approximate(PointId point) const {
    return rows_.approximate(point.index());
  }

  /// True if `approximate` gives the doubles nearest to the coordinates: those of a finite point whose integers are
  /// doubles themselves, as the one quotient is then all that is rounded.
  [[nodiscard]] bool is_nearest(PointId point) const { return finite(point) && rows_.are_doubles(point.index()); }

  /// True if that is so for all points that are finite; false may be said of very few where it is, too. O(n), much
  /// cheaper than to ask for each.
  [[nodiscard]] bool all_are_nearest() const { return rows_.all_are_doubles(); }

  /// Equal for points with the same homogeneous coordinates (as push makes them of equal points).
  [[nodiscard]] std::uint64_t hash(PointId point) const { return rows_.hash(point.index()); }
  [[nodiscard]] bool identical(PointId a, PointId b) const { return identical(a, *this, b); }
  [[nodiscard]] bool identical(PointId a, const PointTable& other, PointId b) const {
    return rows_.equal(a.index(), other.rows_, b.index());
  }

  /// True if no coordinate has a part in R.
  [[nodiscard]] bool finite(PointId point) const { return rows_.is_finite(point.index()); }

  /// The exact coordinates of a finite point.
  [[nodiscard]] Rational3 rational(PointId point) const;
  /// The same of all points, which must be finite.
  [[nodiscard]] std::vector<Rational3> rationals() const;

  [[nodiscard]] std::size_t bytes() const;
  /// Makes room for this many points, and for this many limbs beside what every point takes.
  void reserve(std::size_t points, std::size_t limbs = 0) { rows_.reserve(points, limbs); }
  /// Those of all points.
  [[nodiscard]] std::size_t limbs() const { return rows_.limbs(); }

  /// Gives memory back that has been reserved and not used.
  void trim();

 private:
  // For intermediate results: getting memory for them anew would cost as much as the arithmetic. A copy has its own.
  struct Scratch {
    Scratch() = default;
    ~Scratch() = default;
    Scratch(const Scratch& /*other*/) {}
    Scratch(Scratch&& /*other*/) noexcept {}
    Scratch& operator=(const Scratch& /*other*/) { return *this; }
    Scratch& operator=(Scratch&& /*other*/) noexcept { return *this; }

    std::array<Integer, 7> coordinates;
    Integer minor;
  };

  PointRows rows_;
  Scratch scratch_;
};

}  // namespace nef
