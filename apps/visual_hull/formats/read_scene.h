// SPDX-License-Identifier: Apache-2.0
//
// Any scene: the format is told by the content.
#pragma once

#include <filesystem>
#include <string>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// What a file does not say itself.
struct ReadOptions {
  /// In files that hold matrices by name (OpenCV, MATLAB): the name of the projection matrices, with a `*` for a
  /// number.
  std::string matrices;
};

/// Reads a scene; the format is told by the content of the file:
///  - a folder: a COLMAP model (see colmap.h), a `transforms.json`, NAME.pa or PMVS's NAME.txt (see scene_blocks.h);
///  - JSON: with `frames` NeRF's transforms (see transforms.h), with `cameras` a scene (see scene_json.h);
///  - a file of a COLMAP model stands for the model;
///  - OpenCV's FileStorage, see opencv_storage.h; MATLAB's files of version 5, see matlab.h;
///  - `.vsh` by its extension, see vsh.h;
///  - blocks of intrinsic and extrinsic parameters, see scene_blocks.h;
///  - Middlebury: optionally the number of views, then lines of a name, K (9 numbers), R (9), t (3);
///  - matrices: lines of an optional name and 12 numbers; or a camera as three lines of four
///    numbers, optionally with a line of its own for the name. '#' begins a comment.
/// Images are looked up by images_of. Numbers in texts of our own and in matrices are the rationals that they spell.
/// Throws InputError.
Scene read_scene(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace nef::visual_hull
