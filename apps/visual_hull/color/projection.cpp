// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/color/projection.h"

#include <cmath>

namespace nef::visual_hull {

ImageProjection::ImageProjection(const Camera& camera, PixelOrigin origin, const std::string& option)
    : shift_(origin == PixelOrigin::kCorner ? -0.5 : 0) {
  require_pinhole(camera, option);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) matrix_[i][j] = nef::nearest_double(camera.matrix()[i][j]);
    centre_[i] = nef::nearest_double(camera.centre()[i]);
  }
  // The focal length in pixels: |m0 x m2| / |m2|^2.
  const auto& p = matrix_[0];
  const auto& q = matrix_[2];
  const double area = std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
  pixel_width_ = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) / area;
}

std::optional<ImagePlace> ImageProjection::operator()(const std::array<double, 3>& point) const {
  std::array<double, 3> x{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = matrix_[i][3];
    for (std::size_t j = 0; j < 3; ++j) x[i] += matrix_[i][j] * point[j];
  }
  if (!(x[2] > 0)) return std::nullopt;
  const ImagePlace place{x[0] / x[2] + shift_, x[1] / x[2] + shift_, 1 / x[2]};
  constexpr double kFar = 1e8;  // pixels; also refuses what is not a number
  if (!(std::abs(place.u) < kFar && std::abs(place.v) < kFar)) return std::nullopt;
  return place;
}

}  // namespace nef::visual_hull
