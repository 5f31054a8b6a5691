// SPDX-License-Identifier: Apache-2.0
//
// The colours of texels from the photographs.
#pragma once

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

/// Gives the texels colours: each the colour that the view of its chart has where it sees the point of the texel. What
/// this view does not see, because it is hidden there or at the border of the silhouette, comes from the best other
/// view that sees the triangle. Views in parallel; the result does not depend on the number of threads. O(texels +
/// views (pixels + texels that their own views do not see)).
void sample_views(const TextureInput& input, const Atlas& atlas, const ViewQualities& qualities, Texels& texels,
                  const nef::Monitor& monitor);

}  // namespace nef::visual_hull
