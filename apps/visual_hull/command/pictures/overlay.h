// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "apps/view/image.h"
#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// The image of a view with the hull's projection (filled, blue; its edges thin), what the silhouette has beyond it
/// (the residual, yellow) and the polygon of the silhouette (red) drawn over it. Views without an image get a canvas
/// around their polygons. Of an empty hull the polygon alone is drawn.
cv::Mat draw_overlay(const ViewResult& view, const nef::Polyhedron& hull, PixelOrigin origin);

/// A picture of three channels (blue, green, red) as an image of pages and pictures.
nef::view::Image image_of(const cv::Mat& picture);

/// The bytes of a PNG file of a picture of three channels (blue, green, red).
std::string png_of(const cv::Mat& picture);

/// Writes one PNG per view into `folder` (which is made if need be), named after the views.
/// Throws InputError if that is not possible.
void write_overlays(const Result& result, PixelOrigin origin, const std::filesystem::path& folder);

}  // namespace nef::visual_hull
