// SPDX-License-Identifier: Apache-2.0
//
// A texture for a hull, from the photographs that it was made from.
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "apps/visual_hull/visual_hull.h"
#include "nef/mesh/mesh.h"

namespace nef::visual_hull {

/// An image with all charts, and where the corners of the triangles are in it.
struct HullTexture {
  cv::Mat image;  ///< blue, green, red; at most 4096 pixels a side
  /// For each entry of Mesh::corners its place, from (0, 0) at the lower left to (1, 1) at the upper right.
  std::vector<std::array<float, 2>> corners;
  std::size_t charts = 0;  ///< connected pieces of the surface in the image
  double unseen = 0;  ///< the share of the surface, by texels, that no view sees: it has the colours of its neighbours
};

/// Makes the texture of a mesh of triangles that is closed and near the hull: the hull itself, or a decimated one. Each
/// triangle takes the view that shows it best (resolution and angle; what is visible is decided by maps of depth, see
/// PhotoView), neighbours preferably the same one. What is smooth is the mean over all views that see it, seams between
/// views are levelled, and what no view sees gets the colours of its neighbours. In doubles, for display; the result
/// does not depend on the number of threads. Throws InputError if no view has an image, one can not be read or is a
/// parallel projection, or faces are not triangles. O(views (vertices + pixels + pixels of triangles)), and a sparse
/// system of equations for the seams.
HullTexture hull_texture(const nef::Mesh& mesh, const std::vector<ViewResult>& views, PixelOrigin origin,
                         const nef::Monitor& monitor);

}  // namespace nef::visual_hull
