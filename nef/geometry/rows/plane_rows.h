// SPDX-License-Identifier: Apache-2.0
//
// Coefficients of planes beside their doubles, held once where the doubles say nearly all.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/ranked_bits.h"
#include "nef/number/int128.h"
#include "nef/number/integer_rows.h"

namespace nef {

/// The rows of a PlaneTable: a, b, c (not all 0), d, e, and doubles near a, b, c and d over a power of two above a, b
/// and c, cut off after 53 bits. Of a short row that power, up to 2^126, and the lowest 64 bits of |d|, which has up to
/// 117, are all that the doubles do not say: a, b and c are doubles, and e is 0. Planes of nearly all faces are such,
/// as a normal is a product of two short sides times a power of two; the rest has its integers in a table of their own.
/// Whether a row is short depends on nothing but its integers. Rows are appended and dropped, and never change.
class PlaneRows {
 public:
  using Doubles = std::array<double, 4>;

  [[nodiscard]] std::size_t size() const { return approximate_.size(); }
  /// How many rows there is room for.
  [[nodiscard]] std::size_t capacity() const { return approximate_.capacity(); }

  /// Appends a row, its doubles included; the opposites of the integers must be of two words, too.
  void push(const std::array<Int128, 5>& row);
  void push(const std::array<mpz_srcptr, 5>& row);
  /// Appends a copy of a row of another table.
  void push_from(const PlaneRows& other, std::uint32_t row);
  /// The same for `count` rows, from row `first` on.
  void append(const PlaneRows& other, std::size_t first, std::size_t count);
  /// Takes the last row off again.
  void pop();
  /// Keeps the rows with used[row] other than 0, in their order. O(rows).
  void keep(std::span<const std::uint8_t> used);

  [[nodiscard]] const Doubles& approximate(std::uint32_t row) const { return approximate_[row]; }

  /// Column 0..4: a, b, c, d, e.
  [[nodiscard]] IntegerView at(std::uint32_t row, std::size_t column) const {
    if (!is_short(row)) return long_rows_.at(rank(row), column);
    return IntegerView{column < 3 ? integer(row, column) : column == 3 ? offset(row) : Int128{0}};
  }
  /// All of them.
  [[nodiscard]] std::array<IntegerView, 5> coefficients(std::uint32_t row) const {
    if (!is_short(row)) return long_rows_.first<5>(rank(row));
    return {IntegerView{integer(row, 0)}, IntegerView{integer(row, 1)}, IntegerView{integer(row, 2)},
            IntegerView{offset(row)}, IntegerView{Int128{0}}};
  }
  /// The same if they are below 2^62 in magnitude; else false.
  [[nodiscard]] bool read_small(std::uint32_t row, std::array<std::int64_t, 5>& out) const {
    if (!is_short(row)) return long_rows_.read_small(rank(row), out);
    constexpr int kMost = 62;  // bits
    if (top_[row] > kMost) return false;
    const Doubles& doubles = approximate_[row];
    const double factor = static_cast<double>(std::int64_t{1} << top_[row]);
    if (std::fabs(doubles[3] * factor) >= 0x1p62) return false;
    out = {static_cast<std::int64_t>(doubles[0] * factor), static_cast<std::int64_t>(doubles[1] * factor),
           static_cast<std::int64_t>(doubles[2] * factor), 0, 0};
    const auto size = static_cast<std::int64_t>(low_[row]);
    out[3] = doubles[3] < 0 ? -size : size;
    return true;
  }

  [[nodiscard]] int sign(std::uint32_t row, std::size_t column) const {
    if (!is_short(row)) return long_rows_.sign(rank(row), column);
    return column == 4 ? 0 : (approximate_[row][column] > 0) - (approximate_[row][column] < 0);
  }

  /// True if two rows hold the same integers; they have the same hash then.
  [[nodiscard]] bool equal(std::uint32_t row, const PlaneRows& other, std::uint32_t other_row) const {
    if (top_[row] != other.top_[other_row]) return false;
    if (!is_short(row)) return long_rows_.equal(rank(row), other.long_rows_, other.rank(other_row));
    return low_[row] == other.low_[other_row] && approximate_[row] == other.approximate_[other_row];
  }
  [[nodiscard]] std::uint64_t hash(std::uint32_t row) const;

  [[nodiscard]] std::size_t bytes() const;
  /// Of the integers that are held.
  [[nodiscard]] std::size_t limbs() const { return long_rows_.limbs(); }
  /// Makes room for so many rows, of so many limbs that are held altogether.
  void reserve(std::size_t rows, std::size_t limbs);
  void trim();

 private:
  static constexpr std::uint8_t kLong = 255;

  [[nodiscard]] bool is_short(std::uint32_t row) const { return top_[row] != kLong; }
  [[nodiscard]] std::uint32_t rank(std::uint32_t row) const { return static_cast<std::uint32_t>(long_.rank(row)); }

  // What a double that is an integer over 2^top says of its magnitude.
  [[nodiscard]] static Unsigned128 magnitude_of(double value, int top) {
    const auto bits = std::bit_cast<std::uint64_t>(value) & ~(std::uint64_t{1} << 63U);
    if (bits == 0) return 0;
    const Unsigned128 digits = (bits & ((std::uint64_t{1} << 52U) - 1)) | std::uint64_t{1} << 52U;
    const int shift = static_cast<int>(bits >> 52U) - 1075 + top;
    return shift < 0 ? digits >> -shift : digits << shift;
  }
  [[nodiscard]] Int128 integer(std::uint32_t row, std::size_t column) const {
    const double value = approximate_[row][column];
    const auto size = static_cast<Int128>(magnitude_of(value, top_[row]));
    return value < 0 ? -size : size;
  }
  // |d| is not below what its double says, and by less than 2^64 above it.
  [[nodiscard]] Int128 offset(std::uint32_t row) const {
    const double value = approximate_[row][3];
    const Unsigned128 rough = magnitude_of(value, top_[row]);
    const auto size = static_cast<Int128>(rough + (low_[row] - static_cast<std::uint64_t>(rough)));
    return value < 0 ? -size : size;
  }

  void add(std::uint8_t top, std::uint64_t low, const Doubles& doubles);
  void add_long();

  std::vector<Doubles> approximate_;
  std::vector<std::uint64_t> low_;  // of |d|; of a long row, nothing
  std::vector<std::uint8_t> top_;   // the power of two, or kLong
  RankedBits long_;
  IntegerRows long_rows_{5};
};

}  // namespace nef
