// SPDX-License-Identifier: Apache-2.0
//
// The boundary of a polyhedron's solid parts as a mesh, and a list of what a mesh can not say.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/geometry/point_table.h"

namespace nef {

struct MeshExportOptions {
  /// Keep facets without holes as polygons instead of cutting them into triangles.
  bool keep_polygons = false;
  /// Of these only strictly convex ones of at most four corners. Programs that cut polygons into fans get convex ones
  /// right; with more corners, PrusaSlicer refuses an OBJ file, and Assimp leaves out faces of OFF with ten and more.
  bool only_quads = false;
  /// A set without solid parts gives its surfaces, lines and points.
  bool lower_dimensional = false;
  /// If set, keep only polygons all of whose corners pass: ones that stay planar when they are written, say.
  std::function<bool(const Rational3&)> polygon_corner;
  /// Which marks count as belonging to the set; by default all but 0.
  std::function<bool(LabelId)> selected;
  /// Tell of every face which marks the volumes on its two sides and its facet have.
  bool face_marks = false;
};

struct MeshExport {
  Mesh mesh;           ///< exact; closed, faces counterclockwise as seen from outside the set
  bool closed = true;  ///< false if the faces are a surface, seen from either side
  std::vector<std::array<std::uint32_t, 2>> lines;  ///< between vertices of the mesh, of a set without solid parts
  std::vector<std::uint32_t> points;                ///< the same
  std::vector<std::string> lost;  ///< a line for everything that the mesh does not hold; empty if it is the whole set
  /// If asked for: the marks of the volumes inside and outside of each face (of a surface: below and above it), and of
  /// its facet.
  std::vector<std::array<LabelId, 3>> face_marks;
};

/// The facets between the bounded selected volumes and the rest of space. The mesh is the boundary of the closure of
/// the interior of the set's bounded part: whatever else the set has or lacks (open boundaries, lower-dimensional
/// parts, cracks, unbounded volumes) is told in `lost`. Facets with holes are triangulated exactly, without new
/// vertices. A set without such volumes has an empty mesh, or if the options ask for it, its facets as faces and what
/// lies outside of these as lines and points. O(n) plus the triangulation of facets that are not convex (see
/// nef/mesh/polygon/triangulate.h).
MeshExport to_mesh(const Polyhedron& polyhedron, const MeshExportOptions& options = {}, const Monitor& monitor = {});

/// A mesh whose coordinates are doubles; otherwise as Mesh.
struct RoundedMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::uint32_t> face_begin{0};
  std::vector<std::uint32_t> corners;

  [[nodiscard]] std::size_t face_count() const { return face_begin.size() - 1; }
};

struct RoundedMeshExport {
  RoundedMesh mesh;  ///< the faces of to_mesh, each coordinate rounded once to the nearest double (half to even)
  std::vector<std::string> lost;
};

/// The mesh of to_mesh, rounded. Ten times as fast, as no exact number is made where doubles give the nearest one:
/// quotients of integers below 2^53.
RoundedMeshExport to_rounded_mesh(const Polyhedron& polyhedron, const MeshExportOptions& options = {},
                                  const Monitor& monitor = {});

/// The doubles nearest to the coordinates of a finite point.
std::array<double, 3> nearest_doubles(const PointTable& points, PointId point);

}  // namespace nef
