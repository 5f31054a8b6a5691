// SPDX-License-Identifier: Apache-2.0
//
// Meshes to solids: check, merge equal vertices, find the plane of every face, then draw each
// vertex's sphere map from the corners of the faces around it.
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/from_surface.h"
#include "nef/construct/mesh_check.h"
#include "nef/construct/mesh_faces.h"

namespace nef {

Polyhedron from_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  if (options.as_surface) return from_surface(mesh, options, messages);
  if (mesh.face_count() == 0) throw InputError("the mesh has no faces, so it bounds no solid");
  const MeshSurface surface(mesh);
  bool touching = false;
  if (options.check) {
    for (const MeshProblem& problem : check_mesh(mesh, surface, {.max_per_kind = 1, .self_intersections = true})) {
      if (!problem.legal) throw InputError(problem.text);
      if (problem.kind == MeshProblemKind::kTouching) touching = true;
    }
  }
  MeshFaces faces(mesh, surface, options, messages);
  std::vector<std::vector<std::uint32_t>> parts(1);
  if (touching) {
    // Parts that touch without sharing vertices meet in points that are no vertices of each other's
    // faces; a Boolean operation finds these. By parity, cavities stay cavities.
    parts = faces.components();
    if (parts.size() == 1) {
      throw InputError("the mesh touches itself where it has no common vertices; split the faces there, or the mesh");
    }
  }
  Polyhedron result;
  for (const std::vector<std::uint32_t>& part : parts) {
    Complex complex = faces.solid(part, false);
    if (complex.vertex_count() > 0 && complex.volumes[0].mark == 1) {
      if (parts.size() == 1 && messages != nullptr) {
        messages->push_back("the faces were oriented inward and have been turned over");
      }
      complex = faces.solid(part, true);
    }
    Polyhedron piece{std::move(complex)};
    result = result.is_empty() ? std::move(piece) : regularize(symmetric_difference(result, piece));
  }
  return result;
}

}  // namespace nef
