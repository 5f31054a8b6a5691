// SPDX-License-Identifier: Apache-2.0
//
// The boundary of a polyhedron's solid parts as a mesh, and a list of what a mesh can not say.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "nef/construct/construct.h"

namespace nef {

struct MeshExportOptions {
  /// Keep facets without holes as polygons instead of cutting them into triangles.
  bool keep_polygons = false;
  /// If set, keep only polygons all of whose corners pass: ones that stay planar when they are written, say.
  std::function<bool(const Rational3&)> polygon_corner;
  /// Which marks count as belonging to the set; by default all but 0.
  std::function<bool(LabelId)> selected;
};

struct MeshExport {
  Mesh mesh;                      ///< exact; closed, faces counterclockwise as seen from outside the set
  std::vector<std::string> lost;  ///< a line for everything that the mesh does not hold; empty if it is the whole set
};

/// The facets between the bounded selected volumes and the rest of space. The mesh is the boundary of the closure of
/// the interior of the set's bounded part: whatever else the set has or lacks (open boundaries, lower-dimensional
/// parts, cracks, unbounded volumes) is told in `lost`. Facets with holes are triangulated exactly, without new
/// vertices. O(n) plus the triangulation of facets that are not convex (see nef/construct/triangulate.h).
MeshExport to_mesh(const Polyhedron& polyhedron, const MeshExportOptions& options = {});

}  // namespace nef
