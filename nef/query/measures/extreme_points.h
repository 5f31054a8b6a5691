// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "nef/base/monitor.h"
#include "nef/geometry/point_table.h"
#include "nef/geometry/predicates.h"

namespace nef {

/// The smallest and largest coordinates among points of a table, found without making a rational of each.
class ExtremePoints {
 public:
  /// The table must outlive it.
  ExtremePoints(const PointTable& points, const Monitor& monitor) : points_(points), monitor_(monitor) {}

  /// A finite point.
  void add(PointId point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t end = 0; end < 2; ++end) {
        PointId& best = extreme_[end][axis];
        const int wanted = end == 0 ? -1 : 1;
        if (!best.valid() || compare_coordinate(points_, point, best, static_cast<int>(axis), monitor_) == wanted) {
          best = point;
        }
      }
    }
  }

  /// Nothing if there were no points.
  [[nodiscard]] std::optional<std::array<Rational3, 2>> box() const {
    if (!extreme_[0][0].valid()) return std::nullopt;
    std::array<Rational3, 2> result;
    for (std::size_t end = 0; end < 2; ++end) {
      for (std::size_t axis = 0; axis < 3; ++axis) result[end][axis] = points_.rational(extreme_[end][axis])[axis];
    }
    return result;
  }

 private:
  const PointTable& points_;
  Monitor monitor_;
  std::array<std::array<PointId, 3>, 2> extreme_;  // the points with the least coordinates, and with the greatest
};

}  // namespace nef
