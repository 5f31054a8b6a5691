// SPDX-License-Identifier: Apache-2.0
//
// Which sums of features come near the origin, as far as boxes tell.
#pragma once

#include <algorithm>
#include <cmath>

#include "nef/geometry/search/box_tree.h"

namespace nef::minkowski {

/// A closed ball about the origin, for boxes of doubles that are rounded outward. A radius of infinity holds all.
class NearOrigin {
 public:
  explicit NearOrigin(double radius) : radius_(radius) {}

  [[nodiscard]] bool is_all() const { return !(radius_ < HUGE_VAL); }

  /// False only if the sum of what is in two boxes has no point in the ball. Sums of bounds are within one unit of
  /// roundoff, and the squared distance and the squared radius within some 2^-50 of themselves; for radii of moderate
  /// size nothing vanishes.
  [[nodiscard]] bool may_hold(const Box& p, const Box& q) const {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double slack =
          0x1p-50 * (std::fabs(p.low[i]) + std::fabs(p.high[i]) + std::fabs(q.low[i]) + std::fabs(q.high[i]));
      const double gap = std::max({p.low[i] + q.low[i], -(p.high[i] + q.high[i]), slack}) - slack;
      square += gap * gap;
    }
    return !(square > radius_ * radius_ * (1 + 0x1p-40));
  }

  /// The same for what is in one box.
  [[nodiscard]] bool may_hold(const Box& box) const {
    constexpr Box kOrigin{{0, 0, 0}, {0, 0, 0}};
    return may_hold(box, kOrigin);
  }

 private:
  double radius_;
};

}  // namespace nef::minkowski
