// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/polygon/projected_corners.h"

#include <algorithm>
#include <cmath>

namespace nef {

// The filter of turns is that of MeshPoints::orientation_along for points in the box of the polygon: the sides of the
// box, which are no smaller than any difference of coordinates in it, stand for these differences in its bound. Where
// coordinates are integers and products of differences are below 2^52, everything is computed exactly.
//
// Coordinates are within the margin of the truth, so those that differ by more than two margins differ in truth; two
// more are for the rounding of b - gap, which is less than 2^-52 of the largest coordinate, a quarter of the margin.
void ProjectedCorners::assign(std::span<const std::uint32_t> corners, std::size_t axis, int sign) {
  axis_ = axis;
  sign_ = sign;
  axes_ = {(axis + 1) % 3, (axis + 2) % 3};
  if (sign < 0) std::swap(axes_[0], axes_[1]);
  size_ = corners.size();
  if (corners_.size() < size_) corners_.resize(size_);
  small_.clear();
  std::array<double, 2> low{HUGE_VAL, HUGE_VAL};
  std::array<double, 2> high{-HUGE_VAL, -HUGE_VAL};
  const std::span<const std::array<double, 3>> approximate = points_.approximate();
  const auto [first, second] = axes_;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::array<double, 3>& p = approximate[corners[i]];
    const double x = p[first];
    const double y = p[second];
    corners_[i] = {x, y, corners[i], static_cast<std::uint32_t>(i)};
    low = {std::min(low[0], x), std::min(low[1], y)};
    high = {std::max(high[0], x), std::max(high[1], y)};
  }
  std::array<double, 2> size;
  std::array<double, 2> error;
  ordered_ = true;
  for (std::size_t k = 0; k < 2; ++k) {
    const double margin = points_.margin(axes_[k]);
    size[k] = (high[k] - low[k]) * (1 + 0x1p-50) + 2 * margin;
    error[k] = 2 * margin + kRoundingUnit * size[k];
    gap_[k] = points_.moderate() ? 4 * margin : HUGE_VAL;
    ordered_ = ordered_ && gap_[k] == 0;
  }
  if (!points_.moderate()) {
    bound_ = HUGE_VAL;
  } else if (ordered_ && size[0] * size[1] < 0x1p51) {
    bound_ = 0;
  } else {
    bound_ = 3 * (error[0] * size[1] + size[0] * error[1]) + 0x1p-49 * size[0] * size[1] + 1e-290;
  }
}

std::uint32_t ProjectedCorners::blunt_corners() const {
  const auto n = static_cast<std::uint32_t>(size_);
  std::uint32_t blunt = 0;
  for (std::uint32_t i = n - 1, k = 0; k < n; i = k++) {
    if (!turns_left(i == 0 ? n - 1 : i - 1, i, k)) blunt |= 1U << i;
  }
  return blunt;
}

int ProjectedCorners::unsure_turn(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
  if (bound_ == 0) {  // all was computed exactly, so it is 0
    monitor_.count_filter();
    return 0;
  }
  const MeshPoints::Small* p = small(i);
  const MeshPoints::Small* q = small(j);
  const MeshPoints::Small* r = small(k);
  if (p == nullptr || q == nullptr || r == nullptr) {
    return sign_ * points_.orientation_along(point(i), point(j), point(k), axis_, monitor_);
  }
  monitor_.count_exact();
  return sign_ * MeshPoints::orientation_along(*p, *q, *r, axis_);
}

const MeshPoints::Small* ProjectedCorners::small(std::uint32_t i) const {
  if (small_.empty()) small_.resize(size_);
  MeshPoints::Small& coordinates = small_[i];
  std::int64_t& w = coordinates[3];
  if (w == 0 && !points_.read_small(point(i), coordinates)) w = -1;
  return w > 0 ? &coordinates : nullptr;
}

int ProjectedCorners::compare(std::uint32_t i, std::uint32_t k, std::size_t axis) const {
  const MeshPoints::Small* p = small(i);
  const MeshPoints::Small* q = small(k);
  if (p == nullptr || q == nullptr) return points_.compare(point(i), point(k), axis);
  return MeshPoints::compare(*p, *q, axis);
}

bool ProjectedCorners::before_exact(const Corner& a, const Corner& b) const {
  if (a.point == b.point) return false;
  if (const int order = compare(a.index, b.index, axes_[0]); order != 0) return order < 0;
  if (std::abs(a.y - b.y) > gap_[1]) return a.y < b.y;
  if (const int order = compare(a.index, b.index, axes_[1]); order != 0) return order < 0;
  return a.point < b.point;
}

}  // namespace nef
