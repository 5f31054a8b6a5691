// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "nef/geometry/point_table.h"

namespace nef {

/// Points, each held once and known by its number.
class PointNumbers {
 public:
  /// The number of a point without common factors (PointTable::push_reduced), which is taken up if it is new. Expected
  /// O(1).
  std::uint32_t number(const PointTable& from, PointId point);

  [[nodiscard]] const PointTable& table() const { return points_; }

 private:
  void grow();

  PointTable points_;
  std::vector<std::uint32_t> slots_;  // open addressing, a power of two, at most half full
  std::size_t used_ = 0;              // of these
};

}  // namespace nef
