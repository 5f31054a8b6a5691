// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace nef {

/// Disjoint sets of 0 .. n-1. The representative of a set is its smallest member, so results do
/// not depend on the order of unions.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count = 0) { reset(count); }

  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// Amortized near-constant (path halving).
  std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) {
      parent_[x] = parent_[parent_[x]];
      x = parent_[x];
    }
    return x;
  }

  /// Returns true if two sets became one.
  bool unite(std::uint32_t x, std::uint32_t y) {
    x = find(x);
    y = find(y);
    if (x == y) return false;
    if (x > y) std::swap(x, y);
    parent_[y] = x;
    return true;
  }

  /// Makes root() right, until sets are united. O(n).
  void flatten() {
    // The parent of a number is smaller, and has been looked at.
    for (std::uint32_t& parent : parent_) parent = parent_[parent];
  }

  /// What find returns, after flatten(); several threads may ask at once.
  [[nodiscard]] std::uint32_t root(std::uint32_t x) const { return parent_[x]; }

  [[nodiscard]] std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace nef
