// SPDX-License-Identifier: Apache-2.0
//
// Pictures of a hull, and a page that shows it among its cameras and their images.
#pragma once

#include <filesystem>

#include "apps/visual_hull/visual_hull.h"
#include "nef/view/layer.h"

namespace visual_hull {

/// Writes hull.png (from the right, the front and above) and hull_front.png (against +y), hull_right.png (against +x)
/// and hull_top.png (against +z; z is up) into `folder`, which is made if need be. Throws InputError if that is not
/// possible.
void write_preview(const Result& result, const std::filesystem::path& folder, const nef::Monitor& monitor);

/// The layers of a page: the hull, and the cameras, each with its image (or the polygon that it has in its place) on a
/// plane between camera and hull. Images that are large, distorted, or no PNG or JPEG are embedded as smaller PNGs.
std::vector<nef::view::Layer> page_layers(const Result& result, PixelOrigin origin, const nef::Monitor& monitor);

/// Writes the page. Throws nef::Error if the file cannot be written or the viewer was not built.
void write_page(const Result& result, PixelOrigin origin, const std::filesystem::path& file,
                const nef::Monitor& monitor);

}  // namespace visual_hull
