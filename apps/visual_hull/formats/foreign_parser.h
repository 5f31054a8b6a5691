// SPDX-License-Identifier: Apache-2.0
//
// Scenes that another library parses, under limits.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// Calls `read`, which asks another library (`parser` is its name, for messages) for the scene in `file`, in a process
/// of its own (nef/io/bounded_process.h): damaged files make such libraries crash, or take memory and time without
/// bounds. The scene must have what cameras of files have: no polygons, box or threshold. Throws InputError if `read`
/// does, and if it ends in no other way; `bytes` is the size of the file, with which the limits grow.
Scene read_with_limits(const std::filesystem::path& file, const std::string& parser, std::size_t bytes,
                       const std::function<Scene()>& read);

}  // namespace nef::visual_hull
