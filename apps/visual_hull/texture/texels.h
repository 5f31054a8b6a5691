// SPDX-License-Identifier: Apache-2.0
//
// The texels of an atlas: which triangle each belongs to, and its colour.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/visual_hull/texture/charts.h"
#include "apps/visual_hull/texture/surface.h"

namespace nef::visual_hull {

/// Where a colour comes from; larger ones are better.
enum class TexelGrade : std::uint8_t {
  kNone,    ///< no view
  kBorder,  ///< a view at the border of whose silhouette it is
  kInside,  ///< a view
};

/// All texels, row by row.
class Texels {
 public:
  /// The triangle of a texel that belongs to none.
  static constexpr std::uint32_t kFree = 0xffffffffU;

  /// A texel belongs to the triangle that is nearest to its middle, if that is no farther than a texel and a half. O(1)
  /// for each texel near each triangle.
  explicit Texels(const Atlas& atlas);

  [[nodiscard]] std::size_t size() const { return triangle_.size(); }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] int x_of(std::size_t texel) const { return static_cast<int>(texel % static_cast<std::size_t>(width_)); }
  [[nodiscard]] int y_of(std::size_t texel) const { return static_cast<int>(texel / static_cast<std::size_t>(width_)); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] std::uint32_t triangle(std::size_t texel) const { return triangle_[texel]; }
  /// The point of its triangle that a texel shows.
  [[nodiscard]] Weights weights(std::size_t texel) const {
    return nearest_point(atlas_->places[triangle_[texel]], x_of(texel), y_of(texel)).weights;
  }
  /// The texel at a place in the atlas.
  [[nodiscard]] std::size_t texel_at(const Place2& place) const;

  /// Red, green and blue of each texel.
  std::vector<std::array<float, 3>> color;
  std::vector<TexelGrade> grade;

 private:
  const Atlas* atlas_;  // outlives this
  int width_;
  int height_;
  std::vector<std::uint32_t> triangle_;
};

}  // namespace nef::visual_hull
