// SPDX-License-Identifier: Apache-2.0
//
// The exact sum of many rationals.
#pragma once

#include <vector>

#include "nef/number/number.h"

namespace nef {

/// Adds up any number of rationals as a balanced binary tree, so that the cost is near-linear in
/// the size of the operands and the result (adding one after the other is quadratic when the
/// denominators have nothing in common). Holds O(log n) partial sums.
class RationalSum {
 public:
  void add(Rational value) {
    partial_.push_back(std::move(value));
    // A partial sum of 2^k terms for each one in the binary expansion of the count.
    for (std::size_t n = ++count_; n % 2 == 0; n /= 2) join_last();
  }

  /// The sum of what was added so far.
  [[nodiscard]] Rational total() {
    if (partial_.empty()) return 0;
    while (partial_.size() > 1) join_last();
    Rational result = std::move(partial_[0]);
    partial_.clear();
    count_ = 0;
    return result;
  }

 private:
  void join_last() {
    partial_[partial_.size() - 2] += partial_.back();
    partial_.pop_back();
  }

  std::vector<Rational> partial_;
  std::size_t count_ = 0;
};

}  // namespace nef
