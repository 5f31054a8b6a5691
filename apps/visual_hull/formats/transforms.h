// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// Reads the `transforms.json` of NeRF, instant-ngp and nerfstudio: `frames`, each with `transform_matrix` (camera to
/// world, OpenGL's axes: x right, y up, z back), `file_path` (with or without an extension) and perhaps `mask_path`;
/// intrinsics (`fl_x`, `fl_y`, `cx`, `cy`, `w`, `h`, `camera_angle_x`, `camera_angle_y`, `k1`, `k2`, `k3`, `p1`, `p2`)
/// for all frames or for one. Whole image coordinates are corners of pixels: cx = w/2 is the middle. Where the file
/// gives an angle but no width, the first image is looked up for its size. Throws InputError, also for fisheye lenses.
/// https://docs.nerf.studio/quickstart/data_conventions.html
Scene read_transforms(const nlohmann::json& document, const std::filesystem::path& file);

}  // namespace nef::visual_hull
