// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// The folder of a COLMAP model at or below `folder`: itself, `sparse/0`, `sparse` or `0`. Nothing if there is none.
std::optional<std::filesystem::path> colmap_model(const std::filesystem::path& folder);

/// Reads a COLMAP model, `cameras` and `images` as .txt or .bin: world to camera, x right, y down, z ahead; whole image
/// coordinates are corners of pixels. Views are in the order of their names, by number. The models SIMPLE_PINHOLE,
/// PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV and FULL_OPENCV are understood. Images are looked up beside the model and
/// beside the folder `sparse` that holds it. Throws InputError. https://colmap.github.io/format.html
Scene read_colmap(const std::filesystem::path& model);

}  // namespace nef::visual_hull
