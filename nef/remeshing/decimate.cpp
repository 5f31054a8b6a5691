// SPDX-License-Identifier: Apache-2.0
#include "nef/remeshing/decimate.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "nef/export/convert_openmesh.h"
#include "nef/export/to_mesh.h"
#include "nef/import/try_from_mesh.h"
#include "nef/polyhedron.h"
#include "nef/remeshing/collapse_edges.h"
#include "nef/remeshing/sheets.h"
#include "nef/remeshing/triangle_mesh.h"

namespace nef {
namespace {

// What is left of a mesh of triangles. `original` tells which vertex of the exact mesh each vertex of OpenMesh's is.
Mesh collapsed(TriangleMesh work, const Mesh& exact, const std::vector<std::uint32_t>& original,
               std::size_t triangles) {
  collapse_edges(work, triangles);
  Mesh result;
  std::vector<std::uint32_t> number(exact.vertices.size(), static_cast<std::uint32_t>(-1));
  for (const auto f : work.faces()) {
    if (work.status(f).deleted()) continue;
    for (auto v = work.cfv_ccwbegin(f); v != work.cfv_ccwend(f); ++v) {
      const std::uint32_t source = original[static_cast<std::size_t>(v->idx())];
      if (number[source] == static_cast<std::uint32_t>(-1)) {
        number[source] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(exact.vertices[source]);
      }
      result.corners.push_back(number[source]);
    }
    result.face_begin.push_back(static_cast<std::uint32_t>(result.corners.size()));
  }
  return result;
}

bool is_legal(const Mesh& mesh, const Monitor& monitor) {
  return mesh.face_count() > 0 && std::holds_alternative<Polyhedron>(try_from_mesh(mesh, {.monitor = monitor}));
}

// Adds the vertices of faces that mesh_to_openmesh could not fit in even so: a sheet that comes back to an edge.
void add_separate_vertices(const TriangleMesh& work, Sheets& sheets) {
  sheets.original.resize(work.n_vertices());
  for (const auto f : work.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::transform(work.cfv_ccwbegin(f), work.cfv_ccwend(f), corners.begin(),
                   [](const auto& v) { return static_cast<std::uint32_t>(v.idx()); });
    if (corners[0] < sheets.mesh.vertices.size()) continue;
    // All corners are new ones, numbered in the order of the face.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const std::span<const std::uint32_t> face = sheets.mesh.face(static_cast<std::size_t>(f.idx()));
    for (std::size_t i = 0; i < 3; ++i) sheets.original[corners[i]] = sheets.original[face[i]];
  }
}

}  // namespace

DecimatedMesh decimate(const Polyhedron& set, std::size_t triangles, const Monitor& monitor) {
  MeshExport whole = to_mesh(set, {}, monitor);
  const Mesh& exact = whole.mesh;
  if (exact.face_count() == 0) throw InputError("the set has no bounded solid part, so there is no mesh to decimate");
  Sheets sheets = sheets_of(exact);
  const auto work = mesh_to_openmesh<TriangleMesh>(sheets.mesh);
  add_separate_vertices(work, sheets);
  DecimatedMesh result{exact, {}, std::move(whole.lost)};
  constexpr int kAttempts = 8;
  std::size_t wanted = triangles;
  for (int i = 0; i < kAttempts && wanted < exact.face_count(); ++i) {
    Mesh attempt = collapsed(work, exact, sheets.original, wanted);
    if (is_legal(attempt, monitor)) {
      result.mesh = std::move(attempt);
      break;
    }
    wanted += (exact.face_count() - wanted + 1) / 2;
  }
  if (result.mesh.face_count() > triangles && result.mesh.face_count() > wanted) {
    result.notes.push_back("no edge can be collapsed without turning a face over, or a border away: " +
                           std::to_string(result.mesh.face_count()) + " triangles stay");
  } else if (wanted > triangles) {
    result.notes.push_back("with fewer triangles the mesh would touch or cross itself: " +
                           std::to_string(result.mesh.face_count()) + " stay");
  }
  constexpr std::size_t kSplitsPerFace = 20;
  if (result.mesh.face_count() == exact.face_count()) return result;
  result.distance = hausdorff_distance(exact, result.mesh, kSplitsPerFace * exact.face_count());
  return result;
}

}  // namespace nef
