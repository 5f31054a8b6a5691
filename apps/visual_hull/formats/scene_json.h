// SPDX-License-Identifier: Apache-2.0
//
// Scenes and polygons in JSON, in which a number is the rational that it spells.
#pragma once

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// Reads a JSON scene:
///   {"cameras": [{"image": "a.png" or "silhouette": "a.json" or "polygons": [[[u, v], ...], ...],
///                 "name": "...", "P": 3x4 or "K": 3x3, "R": 3x3, "t": 3, "distortion": [...]}, ...],
///    "box": [x0, y0, z0, x1, y1, z1] or [[x0, y0, z0], [x1, y1, z1]], "threshold": 127 or "otsu",
///    "channel": "gray" or "red" or ..., "invert": true}
/// or, where there are `frames`, NeRF's transforms (transforms.h).
/// Matrices may be nested by rows or flat. Paths are relative to the scene file. Throws InputError.
Scene read_json_scene(const std::string& text, const std::filesystem::path& file);

/// Reads the polygons of one view: [[[u, v], ...], ...] or {"polygons": ...}. Throws InputError.
std::vector<Ring> read_polygons(const std::filesystem::path& file);

}  // namespace nef::visual_hull
