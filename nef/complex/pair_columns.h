// SPDX-License-Identifier: Apache-2.0
//
// Columns over shalfedges that hold one number for each pair of twins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nef {

/// A number that both twins of a pair have in common.
class CommonColumn {
 public:
  [[nodiscard]] std::uint32_t operator[](std::size_t half) const { return values_[half >> 1U]; }
  void set(std::size_t half, std::uint32_t value) { values_[half >> 1U] = value; }
  void assign(std::size_t halves, std::uint32_t value) { values_.assign(halves / 2, value); }
  [[nodiscard]] std::size_t size() const { return 2 * values_.size(); }

  /// One for each pair.
  [[nodiscard]] std::vector<std::uint32_t>& pairs() { return values_; }
  [[nodiscard]] const std::vector<std::uint32_t>& pairs() const { return values_; }

 private:
  std::vector<std::uint32_t> values_;
};

/// Numbers of twins that differ in the lowest bit: 2 f for one, 2 f + 1 for the other.
class OppositeColumn {
 public:
  [[nodiscard]] std::uint32_t operator[](std::size_t half) const {
    return values_[half >> 1U] ^ static_cast<std::uint32_t>(half & 1U);
  }
  /// Sets the twin's, too.
  void set(std::size_t half, std::uint32_t value) {
    values_[half >> 1U] = value ^ static_cast<std::uint32_t>(half & 1U);
  }
  void assign(std::size_t halves, std::uint32_t of_even) { values_.assign(halves / 2, of_even); }
  [[nodiscard]] std::size_t size() const { return 2 * values_.size(); }

  /// The number of the even one of each pair.
  [[nodiscard]] std::vector<std::uint32_t>& pairs() { return values_; }
  [[nodiscard]] const std::vector<std::uint32_t>& pairs() const { return values_; }

 private:
  std::vector<std::uint32_t> values_;
};

}  // namespace nef
