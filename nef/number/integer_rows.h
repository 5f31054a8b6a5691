// SPDX-License-Identifier: Apache-2.0
//
// A table of exact integers in one flat pool of limbs: copying it is a few memcpys, reading an
// entry builds no number, and a zero entry costs a byte as a rule.
#pragma once

#include <gmp.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "nef/number/int128.h"
#include "nef/number/number.h"

namespace nef {

/// A read-only view of one integer of a table, or an integer of two words that a table made up. Valid until the table
/// changes.
class IntegerView {
 public:
  /// The highest limb is not zero. The limbs of zero are not looked at: behind the last entry of a table there may be
  /// no memory, but some of GMP's functions read the lowest limb before they look how many there are (mpz_get_si,
  /// mpz_fits_slong_p, mpz_odd_p).
  IntegerView(const mp_limb_t* limbs, int signed_size)
      : value_ MPZ_ROINIT_N(const_cast<mp_limb_t*>(signed_size == 0 ? &kLimbOfZero : limbs), signed_size) {}
  explicit IntegerView(Int128 value) : IntegerView(nullptr, 0) {
    static_assert(GMP_NUMB_BITS == 64);
    const Unsigned128 size = magnitude(value);
    own_ = {static_cast<mp_limb_t>(size), static_cast<mp_limb_t>(size >> 64U)};
    if (size == 0) return;
    const int limbs = own_[1] != 0 ? 2 : 1;
    value_->_mp_d = own_.data();
    value_->_mp_size = value < 0 ? -limbs : limbs;
  }
  IntegerView(const IntegerView& other) : own_(other.own_), value_{*other.value_} {
    if (other.value_->_mp_d == other.own_.data()) value_->_mp_d = own_.data();
  }
  IntegerView& operator=(const IntegerView&) = delete;
  ~IntegerView() = default;

  operator mpz_srcptr() const { return value_; }  // NOLINT(google-explicit-constructor): a view of an mpz is one
  [[nodiscard]] int sign() const { return mpz_sgn(value_); }

 private:
  static constexpr mp_limb_t kLimbOfZero = 0;
  std::array<mp_limb_t, 2> own_{};  // those of an integer of no table
  mpz_t value_;
};

/// Rows of `width` integers each. Rows are appended and dropped, and never change.
class IntegerRows {
 public:
  explicit IntegerRows(std::size_t width) : width_(width) {}

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Appends a row; `row.size()` is the width. Returns its index.
  std::uint32_t push(std::span<const mpz_srcptr> row);

  /// The same for integers of two words, at most nine of them.
  std::uint32_t push(std::span<const Int128> row);

  /// Appends a copy of row `index` of `other` (same width). Returns its new index.
  std::uint32_t push_from(const IntegerRows& other, std::uint32_t index);

  /// Appends `count` rows of `other` (same width), from row `first` on.
  void append(const IntegerRows& other, std::size_t first, std::size_t count);

  /// Entry `column` of row `row`.
  [[nodiscard]] IntegerView at(std::uint32_t row, std::size_t column) const {
    return {limbs_.data() + begin(row, column), size(row * width_ + column)};
  }

  /// The first `count` entries of a row; cheaper than one after another.
  template <std::size_t count>
  [[nodiscard]] std::array<IntegerView, count> first(std::uint32_t row) const {
    const mp_limb_t* limb = limbs_.data() + begin(row);
    std::size_t i = row * width_;
    const auto next = [&] {
      const std::int32_t size = this->size(i++);
      const IntegerView view(limb, size);
      limb += std::abs(size);
      return view;
    };
    return [&]<std::size_t... k>(std::index_sequence<k...> /*columns*/) {
      return std::array<IntegerView, count>{(static_cast<void>(k), next())...};
    }
    (std::make_index_sequence<count>());
  }

  /// The first entries of a row, as many as there is room for; false if one of them is not below 2^62 in magnitude.
  /// Much cheaper than views of them.
  [[nodiscard]] bool read_small(std::uint32_t row, std::span<std::int64_t> out) const {
    if (is_wide_) return false;
    const mp_limb_t* limb = limbs_.data() + begin(row);
    return read_small(sizes_.data() + kPadding + row * width_, limb, out);
  }

  [[nodiscard]] int sign(std::uint32_t row, std::size_t column) const {
    const std::int32_t size = this->size(row * width_ + column);
    return (size > 0) - (size < 0);
  }

  [[nodiscard]] bool is_one(std::uint32_t row, std::size_t column) const {
    return size(row * width_ + column) == 1 && limbs_[begin(row, column)] == 1;
  }

  /// True if the integers of a row are doubles: at most 2^53 in magnitude.
  [[nodiscard]] bool are_doubles(std::uint32_t row) const;
  /// True if those of all rows are below 2^53; only one that is 2^53 itself could still be a double. A fraction of a
  /// nanosecond an integer.
  [[nodiscard]] bool all_are_doubles() const;

  /// True if the two rows hold the same integers.
  [[nodiscard]] bool equal(std::uint32_t row, const IntegerRows& other, std::uint32_t other_row) const;

  /// Order-independent of the tables: equal rows hash equally.
  [[nodiscard]] std::uint64_t hash(std::uint32_t row) const;
  /// What that is, or would be, of a row of at most eight such integers.
  [[nodiscard]] static std::uint64_t hash_of(std::span<const std::int64_t> row);

  /// Takes the last row off again.
  void pop();

  /// Keeps the rows with used[row] other than 0, in their order, without a copy of the table. O(rows).
  void keep(std::span<const std::uint8_t> used);

  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::size_t limbs() const { return limbs_.size(); }
  /// On average, rounded up; 0 if there are no rows.
  [[nodiscard]] std::size_t limbs_per_row() const { return size_ == 0 ? 0 : (limbs_.size() + size_ - 1) / size_; }

  void reserve(std::size_t rows, std::size_t limbs_per_row);

  /// Gives memory back that has been reserved and not used, where that is an eighth of an array or more.
  void trim();

 private:
  // Entries of one limb at most, moving on in the limbs.
  [[nodiscard]] static bool read_small(const std::int8_t* sizes, const mp_limb_t*& limb, std::span<std::int64_t> out) {
    constexpr mp_limb_t kLimit = mp_limb_t{1} << 62U;
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = 0;
      if (sizes[i] == 0) continue;
      if (sizes[i] > 1 || sizes[i] < -1 || *limb >= kLimit) return false;
      out[i] = sizes[i] < 0 ? -static_cast<std::int64_t>(*limb) : static_cast<std::int64_t>(*limb);
      ++limb;
    }
    return true;
  }

  static constexpr std::size_t kPadding = 8;  // bytes before the first size

  // Rows whose first limb is not noted are read on from one that is at most so many before.
  static constexpr std::size_t kTogether = 4;

  [[nodiscard]] static std::size_t first_together(std::size_t row) { return row - row % kTogether; }

  // Where the limbs of an entry begin, and so those of a row; those of the row after the last one, where they end.
  [[nodiscard]] std::size_t begin(std::size_t row, std::size_t column = 0) const {
    return begin_[row / kTogether] + limbs_between(first_together(row) * width_, row * width_ + column);
  }

  // The limbs of a row.
  [[nodiscard]] std::span<const mp_limb_t> limbs_of(std::size_t row) const {
    return {limbs_.data() + begin(row), limbs_between(row * width_, (row + 1) * width_)};
  }

  // How many limbs some entries have.
  [[nodiscard]] std::size_t limbs_between(std::size_t first, std::size_t last) const {
    std::size_t sum = 0;
    if (std::endian::native == std::endian::little && !is_wide_) {
      for (; last - first > kPadding; last -= kPadding) sum += limbs_before(last, kPadding);
      return sum + limbs_before(last, last - first);
    }
    for (std::size_t k = first; k < last; ++k) sum += static_cast<std::size_t>(std::abs(size(k)));
    return sum;
  }

  // The limbs of the `count` entries, at most eight, before one, without a loop, which would cost more than what is
  // done with the entry: eight sizes are read at once, of which the last ones count. Each byte is made positive; as 127
  // is the largest, none carries into its neighbour.
  [[nodiscard]] std::size_t limbs_before(std::size_t i, std::size_t count) const {
    if (count == 0) return 0;
    std::uint64_t sizes = 0;
    std::memcpy(&sizes, &sizes_[i], kPadding);  // ends before entry i, thanks to the padding
    sizes >>= 8 * (kPadding - count);
    const std::uint64_t negative = sizes >> 7U & 0x0101010101010101U;
    sizes = (sizes ^ negative * 0xFF) + negative;
    constexpr std::uint64_t kEven = 0x00FF00FF00FF00FFU;
    return ((sizes & kEven) + (sizes >> 8U & kEven)) * 0x0001000100010001U >> 48U;
  }

  [[nodiscard]] std::int32_t size(std::size_t i) const { return is_wide_ ? wide_[i] : sizes_[kPadding + i]; }
  [[nodiscard]] bool same_sizes(std::uint32_t row, const IntegerRows& other, std::uint32_t other_row) const;
  void begin_row(std::size_t limbs);
  void push_size(std::int32_t size);
  void append_sizes(const IntegerRows& other, std::size_t first, std::size_t last);
  void widen();
  void end_row();

  std::size_t width_;
  std::vector<mp_limb_t> limbs_;
  std::size_t size_ = 0;
  std::vector<std::uint32_t> begin_;  // of row 0, 4, 8, ... up to size(): its first limb; empty before there is a row
  // width_ signed limb counts a row, as GMP keeps them, behind kPadding zeros; in `wide_`, without these, once one of
  // them needs more than a byte. Empty before there is a row: many tables never have one.
  std::vector<std::int8_t> sizes_;
  std::vector<std::int32_t> wide_;
  bool is_wide_ = false;
};

}  // namespace nef
