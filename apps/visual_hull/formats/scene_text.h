// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// Reads Middlebury parameters or projection matrices from text (see read_scene). `file` is for
/// messages and for looking up images. Throws InputError with file and line.
Scene read_text_scene(const std::string& text, const std::filesystem::path& file);

}  // namespace nef::visual_hull
