// SPDX-License-Identifier: Apache-2.0
//
// Texels that no view sees, and those between charts.
#pragma once

#include "apps/visual_hull/texture/charts.h"
#include "apps/visual_hull/texture/texels.h"

namespace nef::visual_hull {

/// Gives the texels of triangles that no view sees colours of their neighbours: within a chart from texel to texel, in
/// charts without any colour from vertex to vertex of the surface. O(n + texels).
void fill_unseen(const nef::Mesh& mesh, const Surface& surface, const Atlas& atlas, Texels& texels);

/// The image, blue, green, red; texels of no triangle get the colour of the nearest one that has a triangle, so that
/// filters do not mix colours of nothing into the borders of charts. O(texels).
cv::Mat padded_image(const Texels& texels);

}  // namespace nef::visual_hull
