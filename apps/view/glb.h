// SPDX-License-Identifier: Apache-2.0
//
// Layers as a binary glTF 2.0 file, for any viewer of such files.
#pragma once

#include <string>
#include <vector>

#include "apps/view/layer.h"

namespace nef::view {

/// The bytes of the file. One node for each layer, with a child for each selected volume (its closed boundary, facing
/// outward), and children for facets between unselected volumes, for edges, for isolated vertices and for lines. A
/// layer's motion becomes part of one animation, that of its node's translation and, if it turns, rotation. z is up in
/// the layers and turned to glTF's y; coordinates are floats relative to the centre of everything, which is the
/// translation of the root node. Layers that are not visible are left out of the default scene; the scene "everything"
/// has them, too. O(n).
std::string glb_bytes(const std::vector<Layer>& layers);

/// Writes them. Throws FileError if the file cannot be written.
void write_glb(const std::vector<Layer>& layers, const std::string& path);

}  // namespace nef::view
