// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/visual_hull/scene/camera.h"
#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// What is nearest at the centre of each pixel, in doubles: for display.
class DepthMap {
 public:
  /// A place of the image, in pixels whose centres are whole numbers, and one over the depth there.
  struct Place {
    double u = 0;
    double v = 0;
    double inverse_depth = 0;
  };

  DepthMap(const Camera& camera, PixelOrigin origin, int width, int height);

  /// Nothing for a point that is not in front.
  [[nodiscard]] std::optional<Place> project(const std::array<double, 3>& point) const;

  /// Draws a triangle; it is left out if a corner is not in front.
  void draw(const std::array<std::optional<Place>, 3>& triangle);

  /// True if nothing is nearer, by more than three pixels' width, at all of the pixels around a place in the image.
  [[nodiscard]] bool sees(const Place& place) const;

 private:
  int width_;
  int height_;
  double shift_;
  double slack_ = 0;  // three pixels, as a part of the depth
  std::array<std::array<double, 4>, 3> matrix_{};
  std::vector<double> nearest_;  // one over the depth
};

}  // namespace nef::visual_hull
