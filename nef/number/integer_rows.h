// SPDX-License-Identifier: Apache-2.0
//
// A table of exact integers in one flat pool of limbs: copying it is a few memcpys, reading an
// entry builds no number, and a zero entry costs four bytes.
#pragma once

#include <gmp.h>

#include <cstdint>
#include <span>
#include <vector>

#include "nef/number/number.h"

namespace nef {

/// A read-only view of one integer of an IntegerRows. Valid until the table changes.
class IntegerView {
 public:
  IntegerView(const mp_limb_t* limbs, mp_size_t signed_size) { mpz_roinit_n(value_, limbs, signed_size); }
  operator mpz_srcptr() const { return value_; }  // NOLINT(google-explicit-constructor): a view of an mpz is one
  [[nodiscard]] int sign() const { return mpz_sgn(value_); }

 private:
  mpz_t value_;
};

/// Rows of `width` integers each. Rows are appended and never change.
class IntegerRows {
 public:
  explicit IntegerRows(std::size_t width) : width_(width), begin_{0} {}

  [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }

  /// Appends a row; `row.size()` is the width. Returns its index.
  std::uint32_t push(std::span<const mpz_srcptr> row);

  /// Appends a copy of row `index` of `other` (same width). Returns its new index.
  std::uint32_t push_from(const IntegerRows& other, std::uint32_t index);

  /// Appends all rows of `other` (same width).
  void append(const IntegerRows& other);

  /// Entry `column` of row `row`.
  [[nodiscard]] IntegerView at(std::uint32_t row, std::size_t column) const {
    const std::int32_t* sizes = &sizes_[row * width_];
    std::size_t offset = begin_[row];
    for (std::size_t i = 0; i < column; ++i) offset += static_cast<std::size_t>(sizes[i] < 0 ? -sizes[i] : sizes[i]);
    return {limbs_.data() + offset, sizes[column]};
  }

  [[nodiscard]] int sign(std::uint32_t row, std::size_t column) const {
    const std::int32_t size = sizes_[row * width_ + column];
    return (size > 0) - (size < 0);
  }

  /// True if the two rows hold the same integers.
  [[nodiscard]] bool equal(std::uint32_t row, const IntegerRows& other, std::uint32_t other_row) const;

  /// Order-independent of the tables: equal rows hash equally.
  [[nodiscard]] std::uint64_t hash(std::uint32_t row) const;

  /// Takes the last row off again.
  void pop();

  [[nodiscard]] std::size_t bytes() const;

  void reserve(std::size_t rows, std::size_t limbs_per_row);

 private:
  std::size_t width_;
  std::vector<mp_limb_t> limbs_;
  std::vector<std::uint64_t> begin_;  // size()+1 offsets into limbs_
  std::vector<std::int32_t> sizes_;   // width_ signed limb counts a row, as GMP keeps them
};

}  // namespace nef
