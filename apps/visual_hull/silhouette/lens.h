// SPDX-License-Identifier: Apache-2.0
//
// Contours without the distortion of a lens.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apps/visual_hull/polygon/polygon.h"
#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// OpenCV's model of a lens, in doubles: radial (rational), tangential, thin prism and tilt.
class LensModel {
 public:
  explicit LensModel(const Distortion& distortion);

  /// Where the lens shows what a pinhole camera with the same intrinsics sees at `point` (pixels). May be not finite.
  [[nodiscard]] std::array<double, 2> distort(const std::array<double, 2>& point) const;

  /// The inverse, by Newton's method. Nothing if there is none near: beyond the radius at which the lens folds the
  /// image back, or where its denominator has a root.
  [[nodiscard]] std::optional<std::array<double, 2>> straighten(const std::array<double, 2>& point) const;

 private:
  [[nodiscard]] std::array<double, 2> distort_normalized(double x, double y) const;

  std::array<double, 14> c_{};
  std::array<double, 9> tilt_{};  // a homography
  double fx_;
  double fy_;
  double skew_;
  double cx_;
  double cy_;
};

/// Undoes a lens on contours along the sides of pixels: sides become edges of one pixel, of which the straightened
/// ends are taken as the doubles that they are. The rings are those of `traced`, nested alike, and share the same
/// points; nothing is lost where the straightened image is larger than the distorted one. The ring `frame`, if there is
/// one, does not come from the image: it becomes a rectangle around all others. Throws InputError, naming `view`, if a
/// point has no inverse or the rings do not stay simple. O(n log n) for n sides of pixels.
Silhouette straighten(const Silhouette& traced, const Distortion& distortion, const std::string& view,
                      std::optional<std::size_t> frame, const nef::Monitor& monitor);

}  // namespace nef::visual_hull
