// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "apps/visual_hull/visual_hull.h"

namespace nef::visual_hull {

/// The pixels of a view that the hull's projection touches: 255, others 0. As a pinhole camera has them, without the
/// distortion of a lens.
cv::Mat hull_mask(const ViewResult& view, const nef::Polyhedron& hull, PixelOrigin origin);

/// Writes a mask for each view that has an image: NAME.png for the photograph NAME (extension included), in a folder of
/// its name if photographs of several folders share names; and bounding_box.txt, two lines of three numbers, within
/// which the hull lies. That is how COLMAP's stereo_fusion takes them (mask_path, bbox_path). Makes the folder. Throws
/// InputError if no view has an image, two photographs are called alike, or a file cannot be written.
void write_hull_masks(const Result& result, const std::filesystem::path& folder);

}  // namespace nef::visual_hull
