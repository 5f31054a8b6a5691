// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/visual_hull/color/projection.h"

namespace nef::visual_hull {

/// What is nearest at the centre of each pixel, in doubles: for display.
class DepthMap {
 public:
  /// `pixel_width` as ImageProjection has it.
  DepthMap(double pixel_width, int width, int height);

  /// Draws a triangle; it is left out if a corner is not in front.
  void draw(const std::array<std::optional<ImagePlace>, 3>& triangle);

  /// True if nothing is nearer, by more than three pixels' width, at all of the pixels around a place in the image.
  [[nodiscard]] bool sees(const ImagePlace& place) const;

 private:
  int width_;
  int height_;
  double slack_;                 // three pixels, as a part of the depth
  std::vector<double> nearest_;  // one over the depth
};

}  // namespace nef::visual_hull
