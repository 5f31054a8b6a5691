// SPDX-License-Identifier: Apache-2.0
//
// The colours of texels from the photographs.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "apps/visual_hull/texture/charts.h"
#include "apps/visual_hull/texture/texels.h"
#include "apps/visual_hull/texture/view_choice.h"

namespace nef::visual_hull {

/// What a texture is made from.
struct TextureInput {
  const nef::Mesh& mesh;
  const Surface& surface;
  const std::vector<const ViewResult*>& views;
  PixelOrigin origin;
};

/// Mean colours of texels, over all views that see them. Sums are whole numbers, so the order of the views does not
/// matter; `add` may be called by several threads at once.
class MeanColors {
 public:
  /// The largest weight of a colour.
  static constexpr std::uint32_t kFullWeight = 16;

  explicit MeanColors(std::size_t texels) : sums_(texels) {}

  /// Adds a colour (rounded; 0 to 255), with a weight of 1 to kFullWeight. At most a million for each texel.
  void add(std::size_t texel, const std::array<double, 3>& color, std::uint32_t weight);

  /// Whether a texel has any colour.
  [[nodiscard]] bool known(std::size_t texel) const { return sums_[texel][3] > 0; }

  /// Red, green and blue of a texel that is known.
  [[nodiscard]] std::array<float, 3> mean(std::size_t texel) const;

 private:
  std::vector<std::array<std::uint32_t, 4>> sums_;  // weighted red, green and blue, and the weights
};

/// Gives the texels colours: each the colour that the view of its chart has where it sees the point of the texel. What
/// this view does not see, because it is hidden there or at the border of the silhouette, comes from the best other
/// view that sees the triangle. Returns the means over all views that see a texel well inside of their silhouettes;
/// weights are about the cosines of the angles at which they see it. Views in parallel; the result does not depend on
/// the number of threads. O(views (pixels + texels of triangles that they see)).
MeanColors sample_views(const TextureInput& input, const Atlas& atlas, const ViewQualities& qualities, Texels& texels,
                        const nef::Monitor& monitor);

}  // namespace nef::visual_hull
