// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/texture/texels.h"

#include <algorithm>
#include <cmath>

namespace nef::visual_hull {

Texels::Texels(const Atlas& atlas) : atlas_(&atlas), width_(atlas.width), height_(atlas.height) {
  const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  triangle_.assign(count, kFree);
  color.resize(count);
  grade.assign(count, TexelGrade::kNone);
  constexpr double kReach = 1.5;
  std::vector<float> distance(count, static_cast<float>(kReach * kReach));
  for (std::uint32_t t = 0; t < atlas.places.size(); ++t) {
    const Triangle2& place = atlas.places[t];
    for_each_pixel_near(place, kReach, width_, height_, [&](int x, int y) {
      const std::size_t texel = index(x, y);
      if (distance[texel] == 0 && triangle_[texel] != kFree) return;
      const auto own = static_cast<float>(nearest_point(place, x, y).squared_distance);
      if (!(own < distance[texel])) return;
      distance[texel] = own;
      triangle_[texel] = t;
    });
  }
}

std::size_t Texels::texel_at(const Place2& place) const {
  const int x = static_cast<int>(std::clamp(std::round(place[0]), 0.0, width_ - 1.0));
  const int y = static_cast<int>(std::clamp(std::round(place[1]), 0.0, height_ - 1.0));
  return index(x, y);
}

}  // namespace nef::visual_hull
