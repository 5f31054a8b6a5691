// SPDX-License-Identifier: Apache-2.0
//
// Hachenberger's .vsh scenes: cameras and silhouettes as polygons in space.
#pragma once

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// Reads a .vsh text: the room's smallest and largest corner; the number of cameras; per camera its
/// centre, the number of polygons, and per polygon the number of points and the points, all of one
/// camera in one plane that does not hold the centre. Polygons of a camera combine by parity.
/// The view's image plane is that plane, seen along the axis that is steepest on it, so that two
/// of the three coordinates are u and v. Throws InputError.
Scene read_vsh(const std::string& text, const std::filesystem::path& file);

}  // namespace nef::visual_hull
