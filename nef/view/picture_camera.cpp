// SPDX-License-Identifier: Apache-2.0
#include "nef/view/picture_camera.h"

#include <algorithm>
#include <cmath>

namespace nef::view {
namespace {

constexpr double kHalfAngle = 0.26;  // of the shorter side, in radians
constexpr double kMargin = 1.05;

}  // namespace

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

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
  const double across = width / 2 / focal_ / kMargin;  // tangents of the half angles that may be used
  const double along = height / 2 / focal_ / kMargin;
  double distance = 0;
  double extent = 0;
  for (const Point& point : points) {
    const Point p = turned(minus(point, middle_));
    distance = std::max({distance, p[2] + std::abs(p[0]) / across, p[2] + std::abs(p[1]) / along});
    extent = std::max({extent, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  }
  // Never so near that things before the middle blow up; and somewhere if there is only one point.
  distance_ = std::max(distance, extent > 0 ? 2 * extent : 1.0);
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
  return {width_ / 2 + focal_ * p[0] * inverse, height_ / 2 - focal_ * p[1] * inverse, inverse};
}

}  // namespace nef::view
