// SPDX-License-Identifier: Apache-2.0
//
// A mesh as the checks see it: equal vertices merged, faces cut into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/geometry/search/spatial_order.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/mesh_points.h"

namespace nef {

/// Why a face has no triangles.
enum class FaceDefect : std::uint8_t { kNone, kBadIndex, kTooFewCorners, kNoArea, kCrossesItself };

/// The faces of a mesh, cut into triangles.
struct CutFaces {
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of places; none is degenerate
  std::vector<std::uint32_t> face_of;                   ///< of each triangle
  std::vector<std::uint32_t> triangle_begin{0};         ///< of each face, and the end
  std::vector<std::uint32_t> pieces;                    ///< of each triangle: equal where a convex face was cut
  std::vector<FaceDefect> defects;                      ///< of each face
  std::vector<bool> planar;                             ///< of each face: all corners lie in one plane, or on a line
  std::vector<bool> irregular;                          ///< of each face: it names a vertex twice
  std::vector<std::uint32_t> rings;  ///< corners of the planar faces that were cut, as places; none of irregular ones
  std::vector<std::uint32_t> ring_begin{0};  ///< of each face in `rings`, and the end

  /// Makes room for so many of each.
  void reserve(std::size_t faces, std::size_t of_triangles, std::size_t ring_corners);
  /// Appends the faces that come next. O(their size).
  void append(const CutFaces& next);
};

/// The triangulated surface of a mesh. A face may come to a vertex twice, as one with a hole that is joined to the
/// outer ring by a bridge does; sides that are walked out and back at once do not count.
struct MeshSurface : CutFaces {
  /// O(n log n), on the threads of `monitor`.
  MeshSurface(const Mesh& mesh, const Monitor& monitor);
  /// The same with the vertices at `at`, where equal ones have equal doubles: those of the mesh are only counted.
  MeshSurface(const Mesh& mesh, MeshPoints at, const Monitor& monitor);

  MeshPoints points;                 ///< of all vertices of the mesh
  std::vector<SpatialKey> curve;     ///< all vertices along a space-filling curve (spatial_keys)
  std::vector<std::uint32_t> place;  ///< of each vertex: the smallest vertex at the same point

  /// The corners of a triangle as its face names them, instead of the smallest vertices at their points.
  [[nodiscard]] std::array<std::uint32_t, 3> corners_in_face(const Mesh& mesh, std::uint32_t triangle) const {
    std::array<std::uint32_t, 3> corners = triangles[triangle];
    for (std::uint32_t& v : corners) {
      for (const std::uint32_t own : mesh.face(face_of[triangle])) {
        if (place[own] == v) {
          v = own;
          break;
        }
      }
    }
    return corners;
  }

  /// Calls visit(a, b, c) for the triangles into which a face was cut, or for a fan if it was not.
  template <typename Visit>
  void for_each_triangle(const Mesh& mesh, std::uint32_t face, Visit&& visit) const {
    for (std::uint32_t t = triangle_begin[face]; t < triangle_begin[face + 1]; ++t) {
      visit(triangles[t][0], triangles[t][1], triangles[t][2]);
    }
    if (triangle_begin[face] != triangle_begin[face + 1]) return;
    const auto ring = mesh.face(face);
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) visit(ring[0], ring[i], ring[i + 1]);
  }

  /// The corners of a planar face that was cut and names no vertex twice; none for others.
  [[nodiscard]] std::span<const std::uint32_t> ring(std::uint32_t face) const {
    return std::span(rings).subspan(ring_begin[face], ring_begin[face + 1] - ring_begin[face]);
  }
};

}  // namespace nef
