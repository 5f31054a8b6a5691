// SPDX-License-Identifier: Apache-2.0
//
// Meshes in binary glTF 2.0 (.glb): positions in single precision, triangles.
#pragma once

#include <string>
#include <string_view>

#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_parts.h"
#include "nef/io/mesh/mesh_writer.h"

namespace nef {

/// All triangles (also of strips and fans) of the default scene, or of all nodes if there is none, with the nodes'
/// transformations done exactly. glTF's y points up; here z does, so (x, y, z) is read as (x, -z, y). Equal points are
/// one vertex. `parts`, if not null, receives nodes (with those below them), meshes and materials by their names.
/// Buffers outside of the file, compressed or quantized positions are refused. Throws FileError.
Mesh read_glb(std::string_view bytes, const std::string& path, MeshParts* parts = nullptr);

/// One node with the mesh's triangles; its matrix turns z up to y up, so that the numbers are the mesh's, rounded to
/// the nearest floats. Each group of faces is a primitive with a material of its name; the node moves the mesh by the
/// offset.
std::string glb_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});

}  // namespace nef
