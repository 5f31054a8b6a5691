// SPDX-License-Identifier: Apache-2.0
//
// The corners of one polygon in the plane of two coordinates, side by side in memory, and exact predicates on them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/timing/predicate_counts.h"
#include "nef/mesh/mesh_points.h"

namespace nef {

/// Corners of a polygon on the points of one MeshPoints, numbered in the order in which they are given, as seen along a
/// coordinate axis from the side on which the polygon turns counterclockwise. All answers are exact. Keeps its memory
/// from polygon to polygon.
class ProjectedCorners {
 public:
  struct Corner {
    double x = 0;
    double y = 0;
    std::uint32_t point = 0;
    std::uint32_t index = 0;  // its number among the corners
  };

  /// `points` must outlive the corners.
  explicit ProjectedCorners(const MeshPoints& points) : points_(points) {}

  /// Takes the corners of another polygon: the numbers of their points, the axis along which its plane projects one to
  /// one, and +1 if it turns counterclockwise there as MeshPoints::orientation_along sees it, else -1. O(n).
  void assign(std::span<const std::uint32_t> corners, std::size_t axis, int sign);

  [[nodiscard]] std::size_t size() const { return corners_.size(); }
  [[nodiscard]] const Corner& operator[](std::uint32_t i) const { return corners_[i]; }
  [[nodiscard]] std::uint32_t point(std::uint32_t i) const { return corners_[i].point; }

  /// +1 if the corners i, j, k turn counterclockwise, 0 if they lie on one line, -1 else.
  [[nodiscard]] int turn(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    const Corner& a = corners_[i];
    const Corner& b = corners_[j];
    const Corner& c = corners_[k];
    const double value = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (value > bound_ || value < -bound_ || bound_ == 0) {
      ++predicate_counts().filter;
      return (value > 0) - (value < 0);
    }
    return sign_ * points_.orientation_along(a.point, b.point, c.point, axis_);
  }

  /// Lexicographic order; corners at one point by the number of that point.
  [[nodiscard]] bool before(const Corner& a, const Corner& b) const {
    if (a.x < b.x - gap_[0]) return true;
    if (a.x > b.x + gap_[0]) return false;
    if (!ordered_) return before_exact(a, b);
    if (a.y != b.y) return a.y < b.y;
    return a.point < b.point;
  }

 private:
  [[nodiscard]] bool before_exact(const Corner& a, const Corner& b) const;

  const MeshPoints& points_;
  std::size_t axis_ = 2;
  int sign_ = 1;
  std::array<std::size_t, 2> axes_{0, 1};
  std::vector<Corner> corners_;
  double bound_ = 0;             // a turn of this magnitude in doubles is one; 0 if all turns are exact
  std::array<double, 2> gap_{};  // coordinates that differ by more do so in truth, too
  bool ordered_ = false;         // the doubles are the coordinates
};

}  // namespace nef
