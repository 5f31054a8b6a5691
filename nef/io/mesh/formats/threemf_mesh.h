// SPDX-License-Identifier: Apache-2.0
//
// Meshes in 3MF (3D Manufacturing Format, core specification 1.3): a zip archive of XML.
#pragma once

#include <string>
#include <string_view>

#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_parts.h"
#include "nef/io/mesh/mesh_writer.h"

namespace nef {

/// The type of the relationship to a model, and the XML namespaces of models and of what they look like.
inline constexpr const char* kThreemfModelType = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
inline constexpr const char* kThreemfCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
inline constexpr const char* kThreemfMaterials = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";

/// The triangles of everything that the file builds: meshes and components of objects, also in other parts of the
/// archive, with their transformations done exactly; mirrored ones are turned over. Objects of support are left out.
/// Numbers mean the decimals that they spell, scaled to millimetres. Equal points are one vertex. Colours, materials
/// and textures are skipped. `parts`, if not null, receives objects with their components. Throws FileError for a
/// damaged archive, XML that is not well formed or has a document type, an index of nothing, a required extension that
/// may hold shapes (beams, slices), and for archives or components that grow beyond all measure when they are unpacked.
Mesh read_3mf(std::string_view bytes, const std::string& path, MeshParts* parts = nullptr);

/// One object with the mesh's triangles, in the fewest decimals that tell the nearest doubles, moved by the offset
/// where it is built; with colours of its vertices or an image, which the archive contains (materials extension 1.2).
std::string threemf_bytes(const Mesh& mesh, const MeshWriteOptions& options = {});

}  // namespace nef
