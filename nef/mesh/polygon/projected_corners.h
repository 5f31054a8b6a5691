// SPDX-License-Identifier: Apache-2.0
//
// The corners of one polygon in the plane of two coordinates, side by side in memory, and exact predicates on them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
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
  ProjectedCorners(const MeshPoints& points, const Monitor& monitor) : points_(points), monitor_(monitor) {}

  /// Takes the corners of another polygon: the numbers of their points, the axis along which its plane projects one to
  /// one, and +1 if it turns counterclockwise there as MeshPoints::orientation_along sees it, else -1. O(n).
  void assign(std::span<const std::uint32_t> corners, std::size_t axis, int sign);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Corner& operator[](std::uint32_t i) const { return corners_[i]; }
  [[nodiscard]] std::uint32_t point(std::uint32_t i) const { return corners_[i].point; }

  /// +1 if the corners i, j, k turn counterclockwise, 0 if they lie on one line, -1 else.
  [[nodiscard]] int turn(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    const double value = rough_turn(corners_[i], corners_[j], corners_[k]);
    if (value > bound_ || value < -bound_) {
      monitor_.count_filter();
      return value > 0 ? 1 : -1;
    }
    return unsure_turn(i, j, k);
  }

  /// True if they turn counterclockwise.
  [[nodiscard]] bool turns_left(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    const double value = rough_turn(corners_[i], corners_[j], corners_[k]);
    if (value > bound_ || value < -bound_) {
      monitor_.count_filter();
      return value > 0;
    }
    return unsure_turn(i, j, k) > 0;
  }

  /// Of a ring of at most 32 corners in their order: a bit for each that does not turn counterclockwise.
  [[nodiscard]] std::uint32_t blunt_corners() const;

  /// A triangle of corners that turn counterclockwise, asked which other ones it holds.
  class Triangle {
   public:
    Triangle(const ProjectedCorners& corners, std::uint32_t i, std::uint32_t j, std::uint32_t k)
        : all_(corners), ijk_{i, j, k}, a_(corners[i]), b_(corners[j]), c_(corners[k]) {}

    /// True for a corner inside or on the border, but for those at the points of the triangle's own.
    [[nodiscard]] bool holds(std::uint32_t corner) const {
      const Corner& p = all_[corner];
      if (is_right_of(c_, a_, p) || is_right_of(a_, b_, p) || is_right_of(b_, c_, p)) {
        all_.monitor_.count_filter();
        return false;
      }
      if (p.point == a_.point || p.point == b_.point || p.point == c_.point) return false;
      return all_.turn(ijk_[2], ijk_[0], corner) >= 0 && all_.turn(ijk_[0], ijk_[1], corner) >= 0 &&
             all_.turn(ijk_[1], ijk_[2], corner) >= 0;
    }

    /// Coordinates of corners in the triangle are not below these, 0 for x and 1 for y, and not above those.
    [[nodiscard]] std::array<double, 2> low() const {
      return {std::min({a_.x, b_.x, c_.x}) - all_.gap_[0], std::min({a_.y, b_.y, c_.y}) - all_.gap_[1]};
    }
    [[nodiscard]] std::array<double, 2> high() const {
      return {std::max({a_.x, b_.x, c_.x}) + all_.gap_[0], std::max({a_.y, b_.y, c_.y}) + all_.gap_[1]};
    }

   private:
    [[nodiscard]] bool is_right_of(const Corner& from, const Corner& to, const Corner& p) const {
      return rough_turn(from, to, p) < -all_.bound_;
    }

    const ProjectedCorners& all_;
    std::array<std::uint32_t, 3> ijk_;
    Corner a_, b_, c_;
  };

  /// Lexicographic order; corners at one point by the number of that point.
  [[nodiscard]] bool before(const Corner& a, const Corner& b) const {
    if (ordered_) return before_ordered(a, b);
    if (a.x < b.x - gap_[0]) return true;
    if (a.x > b.x + gap_[0]) return false;
    return before_exact(a, b);
  }

  /// True if before_ordered says what before does: the doubles are the coordinates.
  [[nodiscard]] bool ordered() const { return ordered_; }
  [[nodiscard]] static bool before_ordered(const Corner& a, const Corner& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.point < b.point;
  }

 private:
  // Twice the area of the triangle in doubles, off by at most bound_; positive where it turns counterclockwise.
  [[nodiscard]] static double rough_turn(const Corner& a, const Corner& b, const Corner& c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  }
  // Where the bound leaves it open. Not in the header, so that what calls for a turn stays short.
  [[nodiscard]] int unsure_turn(std::uint32_t i, std::uint32_t j, std::uint32_t k) const;
  [[nodiscard]] bool before_exact(const Corner& a, const Corner& b) const;
  [[nodiscard]] int compare(std::uint32_t i, std::uint32_t k, std::size_t axis) const;
  [[nodiscard]] const MeshPoints::Small* small(std::uint32_t i) const;

  const MeshPoints& points_;
  Monitor monitor_;
  std::size_t axis_ = 2;
  int sign_ = 1;
  std::array<std::size_t, 2> axes_{0, 1};
  std::vector<Corner> corners_;  // the first size_ of them
  std::size_t size_ = 0;
  double bound_ = 0;             // a turn of this magnitude in doubles is one; 0 if all turns are exact
  std::array<double, 2> gap_{};  // coordinates that differ by more do so in truth, too
  bool ordered_ = false;         // the doubles are the coordinates
  // Of corners that doubles did not tell apart, which are asked about again and again, as those on one line are: w is 0
  // of those not read yet, -1 of those that have none. Empty until the first such question about the polygon.
  mutable std::vector<MeshPoints::Small> small_;
};

}  // namespace nef
