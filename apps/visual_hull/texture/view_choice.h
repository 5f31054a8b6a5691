// SPDX-License-Identifier: Apache-2.0
//
// Which view each triangle of a hull takes its texture from.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/visual_hull/texture/surface.h"
#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// How well each view shows each triangle.
class ViewQualities {
 public:
  ViewQualities(std::size_t triangles, std::size_t views) : views_(views), values_(triangles * views, 0) {}

  /// Square pixels of the triangle's image that the view sees, times the cosine of the angle to its normal; less at the
  /// border of the silhouette; 0 if it sees nothing of the triangle.
  [[nodiscard]] float& at(std::size_t triangle, std::size_t view) { return values_[triangle * views_ + view]; }
  [[nodiscard]] float at(std::size_t triangle, std::size_t view) const { return values_[triangle * views_ + view]; }
  [[nodiscard]] std::size_t views() const { return views_; }

 private:
  std::size_t views_;
  std::vector<float> values_;
};

/// The view of a triangle that no view sees.
inline constexpr std::uint32_t kNoView = 0xffffffffU;

/// Measures all views, in parallel. Throws as PhotoView does. O(views (vertices + pixels + pixels of triangles)).
ViewQualities measure_views(const nef::Mesh& mesh, const Surface& surface, const std::vector<const ViewResult*>& views,
                            PixelOrigin origin, const nef::Monitor& monitor);

/// For each triangle the view that shows it best; it prefers the views of its neighbours, so that neighbours form
/// charts, if these show it nearly as well. kNoView if none sees it. O(n) for n triangles.
std::vector<std::uint32_t> choose_views(const Surface& surface, const ViewQualities& qualities);

}  // namespace nef::visual_hull
