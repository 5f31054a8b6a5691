// SPDX-License-Identifier: Apache-2.0
//
// Homogeneous coordinates beside their doubles, held once where the doubles say it all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/ranked_bits.h"
#include "nef/number/integer_rows.h"

namespace nef {

/// The rows of a PointTable: x, y, z, w > 0, x', y', z', and doubles near x / w, y / w, z / w. Of a short row, finite
/// and of integers up to 2^50 (2^53 if w is a power of two), the doubles and w tell the integers: each is the one
/// nearest to double times w. Nearly all vertices of meshes are such, and take a byte more than their doubles; the rest
/// has its integers in a table of their own. Few different w that are no powers of two have a code; rows with others
/// are not short, so that a row may be short in one table and not in another. Rows are appended and dropped, and never
/// change.
class PointRows {
 public:
  using Doubles = std::array<double, 3>;

  [[nodiscard]] std::size_t size() const { return approximate_.size(); }

  /// Appends a row, its doubles included.
  void push(const std::array<Int128, 7>& row);
  void push(const std::array<mpz_srcptr, 7>& row);
  /// Appends a copy of a row of another table.
  void push_from(const PointRows& other, std::uint32_t row);
  /// The same for `count` rows, from row `first` on.
  void append(const PointRows& other, std::size_t first, std::size_t count);
  /// Takes the last row off again.
  void pop();

  [[nodiscard]] const Doubles& approximate(std::uint32_t row) const { return approximate_[row]; }

  /// Column 0..2: x, y, z; 3: w; 4..6: x', y', z'.
  [[nodiscard]] IntegerView at(std::uint32_t row, std::size_t column) const {
    if (!is_short(row)) return long_rows_.at(rank(row), column);
    return IntegerView{Int128{column < 3 ? integer(row, column) : column == 3 ? denominator(row) : 0}};
  }
  /// x, y, z, w.
  [[nodiscard]] std::array<IntegerView, 4> coordinates(std::uint32_t row) const {
    if (!is_short(row)) return long_rows_.first<4>(rank(row));
    return {IntegerView{Int128{integer(row, 0)}}, IntegerView{Int128{integer(row, 1)}},
            IntegerView{Int128{integer(row, 2)}}, IntegerView{Int128{denominator(row)}}};
  }
  /// All seven if they are below 2^62 in magnitude; else false.
  [[nodiscard]] bool read_small(std::uint32_t row, std::array<std::int64_t, 7>& out) const {
    if (!is_short(row)) return long_rows_.read_small(rank(row), out);
    out = {integer(row, 0), integer(row, 1), integer(row, 2), denominator(row), 0, 0, 0};
    return true;
  }

  [[nodiscard]] int sign(std::uint32_t row, std::size_t column) const {
    if (!is_short(row)) return long_rows_.sign(rank(row), column);
    if (column > 2) return column == 3 ? 1 : 0;
    return (approximate_[row][column] > 0) - (approximate_[row][column] < 0);
  }
  [[nodiscard]] bool is_finite(std::uint32_t row) const {
    return is_short(row) || (sign(row, 4) == 0 && sign(row, 5) == 0 && sign(row, 6) == 0);
  }
  /// True if w is 1.
  [[nodiscard]] bool are_integers(std::uint32_t row) const {
    return is_short(row) ? denominator(row) == 1 : long_rows_.is_one(rank(row), 3);
  }
  /// True if the integers of a row are doubles: at most 2^53 in magnitude.
  [[nodiscard]] bool are_doubles(std::uint32_t row) const { return is_short(row) || long_rows_.are_doubles(rank(row)); }
  /// True if that is so for all rows; false may be said of very few where it is, too.
  [[nodiscard]] bool all_are_doubles() const { return long_.count() == 0 || long_rows_.all_are_doubles(); }

  /// True if two rows hold the same integers; they have the same hash then.
  [[nodiscard]] bool equal(std::uint32_t row, const PointRows& other, std::uint32_t other_row) const;
  [[nodiscard]] std::uint64_t hash(std::uint32_t row) const;

  [[nodiscard]] std::size_t bytes() const;
  /// Of the integers that are held.
  [[nodiscard]] std::size_t limbs() const { return long_rows_.limbs(); }
  /// Makes room for so many rows, of so many limbs that are held altogether.
  void reserve(std::size_t rows, std::size_t limbs);
  void trim();

 private:
  using Code = std::uint8_t;
  // A code below kListed means w = 2^code.
  static constexpr Code kListed = 54;
  static constexpr Code kLong = 255;

  [[nodiscard]] bool is_short(std::uint32_t row) const { return code_[row] != kLong; }
  [[nodiscard]] std::uint32_t rank(std::uint32_t row) const { return static_cast<std::uint32_t>(long_.rank(row)); }
  [[nodiscard]] std::int64_t denominator(std::uint32_t row) const {
    const Code code = code_[row];
    return code < kListed ? std::int64_t{1} << code : listed_[code - kListed];
  }
  // Times a power of two, a double is the integer; else it is less than half off.
  [[nodiscard]] std::int64_t integer(std::uint32_t row, std::size_t column) const {
    const double value = approximate_[row][column] * static_cast<double>(denominator(row));
    const double half = code_[row] < kListed ? 0.0 : 0.5;
    return static_cast<std::int64_t>(value < 0 ? value - half : value + half);
  }

  bool push_short(const std::array<Int128, 7>& row);
  [[nodiscard]] Code code_of(std::int64_t denominator);
  void add(Code code, const Doubles& doubles);
  void add_long();

  std::vector<Doubles> approximate_;
  std::vector<Code> code_;
  RankedBits long_;
  IntegerRows long_rows_{7};
  std::vector<std::int64_t> listed_;  // denominators that are no powers of two
};

}  // namespace nef
