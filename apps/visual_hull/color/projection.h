// SPDX-License-Identifier: Apache-2.0
//
// Points of space in the pixels of a view, in doubles: for display.
#pragma once

#include <array>
#include <optional>

#include "apps/visual_hull/scene/camera.h"
#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// A place of an image, in pixels whose centres are whole numbers, and one over the depth there.
struct ImagePlace {
  double u = 0;
  double v = 0;
  double inverse_depth = 0;
};

/// A pinhole camera in doubles.
class ImageProjection {
 public:
  /// Throws InputError, naming `option`, if the camera's lines of sight are parallel.
  ImageProjection(const Camera& camera, PixelOrigin origin, const std::string& option);

  /// Nothing for a point that is not in front, or so far from the image that doubles say nothing of it.
  [[nodiscard]] std::optional<ImagePlace> operator()(const std::array<double, 3>& point) const;

  /// The width of a pixel as a part of the depth: one over the focal length in pixels.
  [[nodiscard]] double pixel_width() const { return pixel_width_; }
  [[nodiscard]] const std::array<double, 3>& centre() const { return centre_; }

 private:
  double shift_;
  double pixel_width_ = 0;
  std::array<std::array<double, 4>, 3> matrix_{};
  std::array<double, 3> centre_{};
};

}  // namespace nef::visual_hull
