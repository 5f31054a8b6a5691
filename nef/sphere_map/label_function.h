// SPDX-License-Identifier: Apache-2.0
//
// What a Boolean operation does to marks, as a table.
#pragma once

#include <functional>
#include <vector>

#include "nef/geometry/ids.h"

namespace nef {

/// A binary function on labels 0 .. n-1, tabulated. kOutside with anything is kOutside.
class LabelFunction {
 public:
  /// f for all labels below `size_a` and `size_b`; f is called once for each pair.
  LabelFunction(std::size_t size_a, std::size_t size_b, const std::function<LabelId(LabelId, LabelId)>& f)
      : size_b_(size_b), table_(size_a * size_b) {
    for (std::size_t a = 0; a < size_a; ++a) {
      for (std::size_t b = 0; b < size_b; ++b) {
        table_[a * size_b + b] = f(static_cast<LabelId>(a), static_cast<LabelId>(b));
      }
    }
  }

  [[nodiscard]] LabelId operator()(LabelId a, LabelId b) const {
    if (a == kOutside || b == kOutside) return kOutside;
    return table_[a * size_b_ + b];
  }

 private:
  std::size_t size_b_;
  std::vector<LabelId> table_;
};

}  // namespace nef
