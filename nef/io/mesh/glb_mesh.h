// SPDX-License-Identifier: Apache-2.0
//
// Meshes in binary glTF 2.0 (.glb): positions in single precision, triangles.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/face_groups.h"

namespace nef {

/// All triangles (also of strips and fans) of the default scene, or of all nodes if there is none, with the nodes'
/// transformations done exactly. glTF's y points up; here z does, so (x, y, z) is read as (x, -z, y). Equal points are
/// one vertex. Buffers outside of the file, compressed or quantized positions are refused. Throws FileError.
Mesh read_glb(std::string_view bytes, const std::string& path);

/// One node with the mesh's triangles; its matrix turns z up to y up, so that the numbers are the mesh's, rounded to
/// the nearest floats. Each group of faces is a primitive with a material of its name. `vertex_colors`: in sRGB, of
/// every vertex, or none. `offset`: the node moves the mesh by it.
std::string glb_bytes(const Mesh& mesh, const FaceGroups& groups = {},
                      const std::vector<std::array<std::uint8_t, 3>>& vertex_colors = {}, const Rational3& offset = {},
                      const Monitor& monitor = {});

}  // namespace nef
