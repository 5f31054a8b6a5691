// SPDX-License-Identifier: Apache-2.0
//
// OMPL.app's problem files (read_cfg in scene.h) as texts, for those who have them from elsewhere than a file.
#pragma once

#include <string>
#include <vector>

#include "apps/planner/scene/scene.h"

namespace nef::planner {

/// As read_cfg, from a text; `path` is what messages call it, and files are named from its folder on. Throws
/// InputError.
Scene parse_cfg(const std::string& text, const std::string& path, const MeshOptions& meshes = scene_meshes(),
                CfgRotations rotations = CfgRotations::kOfEnds);

/// The files that such a text names, of those that it has: robot and world. Throws InputError for a line that is none.
std::vector<std::string> files_of_cfg(const std::string& text, const std::string& path);

}  // namespace nef::planner
