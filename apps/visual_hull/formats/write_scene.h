// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// The scene as JSON (scene_json.h) that reads back as the same numbers: those that are doubles as their decimals, in
/// full, others as fractions. Paths are written as they are. What a scene knows beyond that (its format, the sizes of
/// images, folders to look in) is not written.
std::string write_scene_json(const Scene& scene);

/// The same into a file; paths of images, which are those of the working folder, become relative to it.
void write_scene_file(const std::filesystem::path& file, Scene scene);

}  // namespace nef::visual_hull
