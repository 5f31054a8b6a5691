// SPDX-License-Identifier: Apache-2.0
//
// The colours of a hull, from the photographs that it was made from.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/visual_hull/visual_hull.h"
#include "nef/mesh/mesh.h"

namespace nef::visual_hull {

/// Red, green and blue, in sRGB.
using Color = std::array<std::uint8_t, 3>;

struct VertexColors {
  std::vector<Color> colors;  ///< of each vertex
  std::size_t unseen = 0;     ///< vertices that no view sees: they have the mean of their neighbours' colours
};

/// The photograph that belongs to the image of a silhouette: of the same name, in the folder images beside masks or
/// silhouettes or in the folder above, or else the image itself, which may be colours with alpha.
std::filesystem::path photograph_of(const std::filesystem::path& image);

/// For each vertex of a closed mesh of the hull the mean colour of the views that see it. A view sees it if nothing of
/// the mesh is nearer, by more than three pixels' width, at all four pixels around its image: maps of depth in doubles,
/// made for display; no other answer depends on them. Pixels at the border of a silhouette hold background as well, so
/// views that see the vertex farther inside are preferred. Lens distortion is undone. A view whose camera has not all
/// of the mesh in front shows only the triangles that are. Throws InputError if no view has an image, or one can not be
/// read. O(views (vertices + pixels + pixels of triangles)).
VertexColors vertex_colors(const nef::Mesh& mesh, const std::vector<ViewResult>& views, PixelOrigin origin,
                           const nef::Monitor& monitor);

}  // namespace nef::visual_hull
