// SPDX-License-Identifier: Apache-2.0
#include "apps/view/picture/picture_camera.h"

#include "nef/geometry/vectors.h"

#include <algorithm>
#include <cmath>

namespace nef::view {
namespace {

constexpr double kHalfAngle = 0.22;  // of the shorter side, in radians
constexpr double kMargin = 1.07;

}  // namespace

Point unit(const Point& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Point{a[0] / length, a[1] / length, a[2] / length} : Point{0, 0, 0};
}

PictureCamera::PictureCamera(const Point& from, const Point& middle, std::span<const Point> points, double width,
                             double height)
    : middle_(middle), width_(width), height_(height) {
  const Point back = unit(from);
  // Seen from straight above or below, y is up.
  const Point up = std::hypot(back[0], back[1]) < 1e-6 ? Point{0, 1, 0} : Point{0, 0, 1};
  const Point right = unit(cross(up, back));
  axes_ = {right, cross(back, right), back};
  focal_ = std::min(width, height) / 2 / std::tan(kHalfAngle);
  double extent = 0;
  for (const Point& point : points) {
    for (const double x : turned(minus(point, middle_))) extent = std::max(extent, std::abs(x));
  }
  if (extent == 0) return;
  // Never so near that things before the middle blow up. What fits from some distance fits from any larger one.
  double low = 2 * extent;
  double high = low;
  while (!fits(points, high)) high *= 2;
  for (int i = 0; i < 30 && high > low; ++i) {
    const double between = (low + high) / 2;
    (fits(points, between) ? high : low) = between;
  }
  // The picture of a thing in perspective is not in the middle where the thing is: the picture plane is shifted.
  static_cast<void>(fits(points, high));
}

bool PictureCamera::fits(std::span<const Point> points, double distance) {
  distance_ = distance;
  shift_ = {0, 0};
  std::array<double, 2> low{1e300, 1e300};
  std::array<double, 2> high{-1e300, -1e300};
  for (const Point& point : points) {
    const Projected p = project(point);
    low = {std::min(low[0], p.x), std::min(low[1], p.y)};
    high = {std::max(high[0], p.x), std::max(high[1], p.y)};
  }
  shift_ = {width_ / 2 - (low[0] + high[0]) / 2, height_ / 2 - (low[1] + high[1]) / 2};
  return (high[0] - low[0]) * kMargin <= width_ && (high[1] - low[1]) * kMargin <= height_;
}

Point PictureCamera::turned(const Point& vector) const {
  return {dot(vector, axes_[0]), dot(vector, axes_[1]), dot(vector, axes_[2])};
}

Point PictureCamera::from_eye(const Point& point) const {
  Point v = minus(point, middle_);
  for (std::size_t i = 0; i < 3; ++i) v[i] -= distance_ * axes_[2][i];
  return v;
}

Projected PictureCamera::project(const Point& point) const {
  const Point p = turned(minus(point, middle_));
  const double inverse = 1 / (distance_ - p[2]);
  return {width_ / 2 + shift_[0] + focal_ * p[0] * inverse, height_ / 2 + shift_[1] - focal_ * p[1] * inverse, inverse};
}

}  // namespace nef::view
