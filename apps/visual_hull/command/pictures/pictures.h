// SPDX-License-Identifier: Apache-2.0
//
// A page that shows a hull among its cameras and their images, and a picture of the hull.
#pragma once

#include <filesystem>

#include "apps/view/layer.h"
#include "apps/view/picture.h"
#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// How a hull is coloured.
enum class HullColors : std::uint8_t {
  kPlain,     ///< in one colour for each volume
  kVertices,  ///< by colours of its vertices (vertex_colors.h)
  kTexture,   ///< by an image (hull_texture.h)
};

/// The hull as pages and pictures show it. Colours are found here, once for all of them.
nef::view::Layer hull_layer(const Result& result, PixelOrigin origin, const nef::Monitor& monitor,
                            HullColors colors = HullColors::kPlain);

/// The layers of a page: the hull (hull_layer), and the cameras, each with its image (or the polygon that it has in its
/// place) on a plane between camera and hull. Images that are large, distorted, or no PNG or JPEG are embedded as
/// smaller PNGs.
std::vector<nef::view::Layer> page_layers(const Result& result, PixelOrigin origin, nef::view::Layer hull);

/// Writes the page. Throws nef::Error if the file cannot be written or the viewer was not built.
void write_page(const Result& result, PixelOrigin origin, nef::view::Layer hull, const std::filesystem::path& file);

}  // namespace nef::visual_hull
