// SPDX-License-Identifier: Apache-2.0
//
// The eye of a picture.
#pragma once

#include <optional>
#include <span>

#include "apps/view/scene.h"

namespace nef::view {

/// A point on the picture plane: x to the right and y down in samples, and the inverse of the depth, which is linear on
/// the images of straight things and larger for nearer ones.
struct Projected {
  double x = 0;
  double y = 0;
  double inverse_depth = 0;
};

/// A perspective camera that looks from a direction, just far enough to see all points, with their picture in the
/// middle.
class PictureCamera {
 public:
  /// `from` must not be zero; `middle` is about the middle of the points; the size is in samples.
  PictureCamera(const Point& from, const Point& middle, std::span<const Point> points, double width, double height);

  [[nodiscard]] Projected project(const Point& point) const;
  /// Components of a vector along the camera's right, up, and towards the eye.
  [[nodiscard]] Point turned(const Point& vector) const;
  /// The vector from the eye to a point.
  [[nodiscard]] Point from_eye(const Point& point) const;

 private:
  // Takes a distance, moves the picture of the points to the middle, and tells whether all of it is seen.
  bool fits(std::span<const Point> points, double distance);

  Point middle_;
  std::array<Point, 3> axes_{};  // right, up, towards the eye
  double distance_ = 1;
  std::array<double, 2> shift_{};  // of the picture, in samples
  double focal_ = 1;               // samples for a unit at depth 1
  double width_;
  double height_;
};

Point unit(const Point& a);

}  // namespace nef::view
