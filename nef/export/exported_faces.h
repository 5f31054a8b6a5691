// SPDX-License-Identifier: Apache-2.0
//
// The facets of a boundary as faces of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/export/exported_parts.h"
#include "nef/export/to_mesh.h"

namespace nef {

/// The faces of a mesh, as in Mesh, and what MeshExport::face_marks has of them.
struct ExportedFaces {
  std::vector<std::uint32_t> face_begin{0};
  std::vector<std::uint32_t> corners;
  std::vector<std::array<LabelId, 3>> face_marks;
};

/// Each facet as a polygon if the options allow it, or as triangles. `doubles` are the coordinates of the vertices of
/// the mesh, each within 2^-51 relative of the truth. O(n) plus the triangulation of facets that are not convex.
ExportedFaces exported_faces(const ExportedParts& parts, std::span<const std::array<double, 3>> doubles,
                             const MeshExportOptions& options, const Monitor& monitor);

}  // namespace nef
