// SPDX-License-Identifier: Apache-2.0
//
// The colours of a hull, from the photographs that it was made from.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/color/photo_view.h"
#include "apps/visual_hull/visual_hull.h"
#include "nef/mesh/mesh.h"

namespace nef::visual_hull {

/// Red, green and blue, in sRGB.
using Color = std::array<std::uint8_t, 3>;

/// Colours before rounding, or nothing where there is none.
using FoundColors = std::vector<std::optional<std::array<double, 3>>>;

struct VertexColors {
  std::vector<Color> colors;  ///< of each vertex
  std::size_t unseen = 0;     ///< vertices that no view sees: they have the mean of their neighbours' colours
};

/// For each of some points of the surface of a mesh the mean colour of the views that see it (PhotoView). Views that
/// see it well inside of their silhouette are preferred. A view whose camera has not all of the mesh in front shows
/// only the triangles that are. Throws InputError, naming `option`, if no view has an image, or one can not be read.
/// O(views (points + vertices + pixels + pixels of triangles)).
FoundColors surface_colors(const nef::Mesh& mesh, const std::vector<std::array<double, 3>>& points,
                           const std::vector<ViewResult>& views, PixelOrigin origin, const std::string& option,
                           const nef::Monitor& monitor);

/// Vertices of a mesh without a colour take the mean of their neighbours' colours, in rounds from those that have one.
/// What is connected to none stays without.
void spread_colors(const nef::Mesh& mesh, FoundColors& colors);

/// surface_colors of the vertices of a closed mesh of the hull, spread.
VertexColors vertex_colors(const nef::Mesh& mesh, const std::vector<ViewResult>& views, PixelOrigin origin,
                           const nef::Monitor& monitor);

/// The colour with its channels rounded; grey if there is none.
Color rounded_color(const std::optional<std::array<double, 3>>& color);

}  // namespace nef::visual_hull
