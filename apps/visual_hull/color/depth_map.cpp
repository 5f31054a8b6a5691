// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/color/depth_map.h"

#include <algorithm>
#include <cmath>

#include "apps/visual_hull/color/triangle_pixels.h"

namespace nef::visual_hull {

DepthMap::DepthMap(double pixel_width, int width, int height)
    : width_(width),
      height_(height),
      slack_(3 * pixel_width),
      nearest_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}

void DepthMap::draw(const std::array<std::optional<ImagePlace>, 3>& triangle) {
  if (!triangle[0] || !triangle[1] || !triangle[2]) return;
  const Triangle2 t{
      {{triangle[0]->u, triangle[0]->v}, {triangle[1]->u, triangle[1]->v}, {triangle[2]->u, triangle[2]->v}}};
  const double area = doubled_area(t);
  if (!(std::abs(area) > 0)) return;
  constexpr double kRim = -1e-9;  // no gaps between neighbours
  for_each_pixel_near(t, 1e-6, width_, height_, [&](int x, int y) {
    const Weights w = weights_at(t, area, x, y);
    if (w[0] < kRim || w[1] < kRim || w[2] < kRim) return;
    // One over the depth is affine in the image.
    const double inverse =
        w[0] * triangle[0]->inverse_depth + w[1] * triangle[1]->inverse_depth + w[2] * triangle[2]->inverse_depth;
    double& nearest =
        nearest_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    nearest = std::max(nearest, inverse);
  });
}

bool DepthMap::sees(const ImagePlace& place) const {
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
