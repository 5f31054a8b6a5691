// SPDX-License-Identifier: Apache-2.0
//
// A page that shows a hull among its cameras and their images.
#pragma once

#include <filesystem>

#include "apps/view/layer.h"
#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// The layers of a page: the hull, and the cameras, each with its image (or the polygon that it has in its place) on a
/// plane between camera and hull. Images that are large, distorted, or no PNG or JPEG are embedded as smaller PNGs.
std::vector<nef::view::Layer> page_layers(const Result& result, PixelOrigin origin, const nef::Monitor& monitor);

/// Writes the page. Throws nef::Error if the file cannot be written or the viewer was not built.
void write_page(const Result& result, PixelOrigin origin, const std::filesystem::path& file,
                const nef::Monitor& monitor);

}  // namespace nef::visual_hull
