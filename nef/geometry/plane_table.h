// SPDX-License-Identifier: Apache-2.0
//
// Interned planes: each plane is held once, so that coplanar means same row and no arithmetic is
// ever spent on that question, which is the bottleneck of the thesis' own implementation (9.6.3).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/geometry/ids.h"
#include "nef/geometry/rows/plane_rows.h"
#include "nef/number/row_slots.h"

namespace nef {

/// The set of planes a*x + b*y + c*z + d + e*R = 0 that a polyhedron uses, each with integer
/// coefficients without common factor and a positive first non-zero normal component. R is the
/// infimaximal number (greater than every number there is, thesis 3.3); e is zero but for the
/// planes of an infimaximal box and what transformations make of them.
class PlaneTable {
 public:
  /// The oriented plane with the given coefficients; its positive side is where the form is
  /// positive. Adds it if it is new. The normal must not be zero. Expected O(1).
  PlaneId intern(const Integer& a, const Integer& b, const Integer& c, const Integer& d, const Integer& e = 0);

  /// The same for coefficients that are known to have no common factor.
  PlaneId intern_primitive(const std::array<mpz_srcptr, 4>& normal_and_offset);

  /// The same in integers of two words; their opposites must be such, too.
  PlaneId intern_primitive(const std::array<Int128, 5>& coefficients);

  /// The same for a plane of another table (or of this one).
  PlaneId intern_from(const PlaneTable& other, PlaneId plane);
  /// The same for all planes of another table: the row of each. In less time than one by one.
  std::vector<std::uint32_t> intern_all(const PlaneTable& other);

  /// From now on planes are appended without being looked for, so that equal ones have several rows, until
  /// merge_equal(). Many different planes take less time so.
  void merge_later();
  /// Keeps the first one of equal planes, in their order: for each row the one that it has become, or nothing if no two
  /// planes were equal. Expected O(planes), partly on the threads of `monitor`.
  std::vector<std::uint32_t> merge_equal(const Monitor& monitor = {});

  /// Appends a plane of another table that this one does not hold yet, and returns its row. Cheaper than intern_from:
  /// nothing is looked up.
  std::uint32_t append_new(const PlaneTable& other, std::uint32_t row);
  /// The same for `count` consecutive planes, from row `first` on.
  void append_new(const PlaneTable& other, std::size_t first, std::size_t count);

  /// For each plane of another table its row in this one, or kNotHere. On the threads of `monitor`. O(planes of both).
  [[nodiscard]] std::vector<std::uint32_t> rows_of(const PlaneTable& other, const Monitor& monitor) const;
  static constexpr std::uint32_t kNotHere = 0xffffffffU;

  /// Appends those planes of the other table that rows_of() has not found here, in their order, and fills their rows
  /// in.
  void append_missing(const PlaneTable& other, std::vector<std::uint32_t>& rows);

  /// The plane n.x + d = 0 for a rational normal and offset; scaled to integers.
  PlaneId intern(const Rational3& normal, const Rational& offset);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }

  /// Coefficient `column` (0..2 normal, 3 constant, 4 factor of R) of the *unflipped* plane.
  [[nodiscard]] IntegerView coefficient(PlaneId plane, std::size_t column) const {
    return rows_.at(plane.row(), column);
  }

  /// All five coefficients of the unflipped plane; cheaper than one after another.
  [[nodiscard]] std::array<IntegerView, 5> coefficients(PlaneId plane) const { return rows_.coefficients(plane.row()); }

  /// All five coefficients of the unflipped plane, if they are below 2^62 in magnitude; else false.
  [[nodiscard]] bool small_coefficients(PlaneId plane, std::array<std::int64_t, 5>& out) const {
    return rows_.read_small(plane.row(), out);
  }

  /// Coefficient with the sign of the oriented plane, as a number of its own.
  [[nodiscard]] Integer oriented_coefficient(PlaneId plane, std::size_t column) const;

  /// Doubles for filters, of the unflipped plane: the coefficients scaled by a power of two so
  /// that the largest normal component lies in [1/2, 1); each within 2^-52 relative of the truth.
  /// The offset is infinite for a plane with a factor of R, and where a component of the normal is
  /// so small beside the largest that doubles do not hold it: no filter decides then.
  [[nodiscard]] const std::array<double, 4>& approximate(PlaneId plane) const { return rows_.approximate(plane.row()); }

  /// True if the plane has a part in R.
  [[nodiscard]] bool infimaximal(PlaneId plane) const { return rows_.sign(plane.row(), 4) != 0; }

  [[nodiscard]] std::size_t bytes() const;

  /// Makes room for this many planes, and for this many limbs beside what every plane takes.
  void reserve(std::size_t planes, std::size_t limbs = 0) { rows_.reserve(planes, limbs); }
  /// Those of all planes.
  [[nodiscard]] std::size_t limbs() const { return rows_.limbs(); }

  /// Keeps the planes with used[row] other than 0, in their order, without a copy of the table. O(planes).
  void keep(std::span<const std::uint8_t> used);

  /// Gives memory back that nothing needs until a plane is looked for, or that has been reserved and not used.
  void trim();

 private:
  PlaneId find_or_add_last();
  void make_room_for(std::size_t more, std::size_t planes);

  PlaneRows rows_;
  RowSlots slots_;  // none until a plane is looked for
  bool merges_ = true;
};

}  // namespace nef
