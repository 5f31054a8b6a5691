// SPDX-License-Identifier: Apache-2.0
//
// Charts: neighbouring triangles that take their texture from the same view, laid flat by its camera.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/visual_hull/color/triangle_pixels.h"
#include "apps/visual_hull/texture/surface.h"
#include "apps/visual_hull/texture/view_choice.h"
#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// A chart, and its rectangle in the atlas.
struct Chart {
  std::uint32_t view = kNoView;
  std::vector<std::uint32_t> triangles;
  Place2 low{};  ///< of its places, in whole pixels
  Place2 high{};
  int x = 0;  ///< of its rectangle in the atlas, padding included
  int y = 0;
  int width = 0;
  int height = 0;
};

/// All charts of a surface; each triangle is in one.
struct Atlas {
  std::vector<Chart> charts;
  std::vector<std::uint32_t> chart_of;  ///< of each triangle
  /// Of each triangle: in pixels of its view, centres whole; after `pack` in texels of the atlas, centres whole.
  std::vector<Triangle2> places;
  int width = 0;
  int height = 0;
};

/// Grows charts from triangle to triangle over sides. In a chart of a view, places are images of the corners, and no
/// pixel lies in two triangles: where a part of the surface hides another part of the same chart, another chart begins.
/// What no view sees becomes charts along the normal of their first triangle, at a quarter of the mean resolution.
/// O(n + pixels of triangles).
Atlas make_charts(const Surface& surface, const std::vector<std::uint32_t>& choice,
                  const std::vector<const ViewResult*>& views, PixelOrigin origin);

}  // namespace nef::visual_hull
