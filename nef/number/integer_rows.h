// SPDX-License-Identifier: Apache-2.0
//
// A table of exact integers in one flat pool of limbs: copying it is a few memcpys, reading an
// entry builds no number, and a zero entry costs a byte as a rule.
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

  /// Appends `count` rows of `other` (same width), from row `first` on.
  void append(const IntegerRows& other, std::size_t first, std::size_t count);

  /// Entry `column` of row `row`.
  [[nodiscard]] IntegerView at(std::uint32_t row, std::size_t column) const {
    return wide_.empty() ? view(&sizes_[row * width_], begin_[row], column)
                         : view(&wide_[row * width_], begin_[row], column);
  }

  [[nodiscard]] int sign(std::uint32_t row, std::size_t column) const {
    const std::int32_t size = this->size(row * width_ + column);
    return (size > 0) - (size < 0);
  }

  /// True if the two rows hold the same integers.
  [[nodiscard]] bool equal(std::uint32_t row, const IntegerRows& other, std::uint32_t other_row) const;

  /// Order-independent of the tables: equal rows hash equally.
  [[nodiscard]] std::uint64_t hash(std::uint32_t row) const;

  /// Takes the last row off again.
  void pop();

  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] std::size_t limbs() const { return limbs_.size(); }

  void reserve(std::size_t rows, std::size_t limbs_per_row);

  /// Gives memory back that has been reserved and not used, where that is an eighth of an array or more.
  void trim();

 private:
  template <typename Size>
  [[nodiscard]] IntegerView view(const Size* sizes, std::size_t offset, std::size_t column) const {
    for (std::size_t i = 0; i < column; ++i) offset += static_cast<std::size_t>(sizes[i] < 0 ? -sizes[i] : sizes[i]);
    return {limbs_.data() + offset, sizes[column]};
  }
  [[nodiscard]] std::int32_t size(std::size_t i) const { return wide_.empty() ? sizes_[i] : wide_[i]; }
  [[nodiscard]] bool same_sizes(std::uint32_t row, const IntegerRows& other, std::uint32_t other_row) const;
  void push_size(std::int32_t size);
  void append_sizes(const IntegerRows& other, std::size_t first, std::size_t last);
  void widen();
  void end_row();

  std::size_t width_;
  std::vector<mp_limb_t> limbs_;
  std::vector<std::uint32_t> begin_;  // size()+1 offsets into limbs_
  // width_ signed limb counts a row, as GMP keeps them: in `wide_` once one of them needs more than a byte.
  std::vector<std::int8_t> sizes_;
  std::vector<std::int32_t> wide_;
};

}  // namespace nef
