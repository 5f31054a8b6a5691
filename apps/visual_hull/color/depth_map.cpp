// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/color/depth_map.h"

#include <algorithm>
#include <cmath>

namespace nef::visual_hull {

DepthMap::DepthMap(const Camera& camera, PixelOrigin origin, int width, int height)
    : width_(width),
      height_(height),
      shift_(origin == PixelOrigin::kCorner ? -0.5 : 0),
      nearest_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {
  require_pinhole(camera, "--color");
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) matrix_[i][j] = nef::nearest_double(camera.matrix()[i][j]);
  }
  // The focal length in pixels: |m0 x m2| / |m2|^2.
  const auto& p = matrix_[0];
  const auto& q = matrix_[2];
  const double area = std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
  slack_ = 3 * (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) / area;
}

std::optional<DepthMap::Place> DepthMap::project(const std::array<double, 3>& point) const {
  std::array<double, 3> x{};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = matrix_[i][3];
    for (std::size_t j = 0; j < 3; ++j) x[i] += matrix_[i][j] * point[j];
  }
  if (!(x[2] > 0)) return std::nullopt;
  return Place{x[0] / x[2] + shift_, x[1] / x[2] + shift_, 1 / x[2]};
}

void DepthMap::draw(const std::array<std::optional<Place>, 3>& triangle) {
  if (!triangle[0] || !triangle[1] || !triangle[2]) return;
  const Place& a = *triangle[0];
  const Place& b = *triangle[1];
  const Place& c = *triangle[2];
  const double area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  if (!(std::abs(area) > 0)) return;
  const int top = static_cast<int>(std::ceil(std::clamp(std::min({a.v, b.v, c.v}), 0.0, 1e9)));
  const int bottom = static_cast<int>(std::floor(std::clamp(std::max({a.v, b.v, c.v}), -1.0, height_ - 1.0)));
  const int left = static_cast<int>(std::ceil(std::clamp(std::min({a.u, b.u, c.u}), 0.0, 1e9)));
  const int right = static_cast<int>(std::floor(std::clamp(std::max({a.u, b.u, c.u}), -1.0, width_ - 1.0)));
  constexpr double kRim = -1e-9;  // no gaps between neighbours
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double s = ((x - a.u) * (c.v - a.v) - (y - a.v) * (c.u - a.u)) / area;
      const double t = ((b.u - a.u) * (y - a.v) - (b.v - a.v) * (x - a.u)) / area;
      if (s < kRim || t < kRim || s + t > 1 - kRim) continue;
      // One over the depth is affine in the image.
      const double inverse =
          a.inverse_depth + s * (b.inverse_depth - a.inverse_depth) + t * (c.inverse_depth - a.inverse_depth);
      double& nearest =
          nearest_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
      nearest = std::max(nearest, inverse);
    }
  }
}

bool DepthMap::sees(const Place& place) const {
  const double x = std::floor(place.u);
  const double y = std::floor(place.v);
  if (!(x >= 0 && y >= 0 && x + 1 < width_ && y + 1 < height_)) return false;
  double nearest = 0;
  for (const std::size_t dy : {0, 1}) {
    for (const std::size_t dx : {0, 1}) {
      nearest = std::max(nearest, nearest_[(static_cast<std::size_t>(y) + dy) * static_cast<std::size_t>(width_) +
                                           static_cast<std::size_t>(x) + dx]);
    }
  }
  return place.inverse_depth * (1 + slack_) >= nearest;
}

}  // namespace nef::visual_hull
