// SPDX-License-Identifier: Apache-2.0
//
// Meshes to solids: check, merge equal vertices, find the plane of every face, then draw each
// vertex's sphere map from the corners of the faces around it.
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/fill.h"
#include "nef/construct/from_surface.h"
#include "nef/construct/mesh_check.h"
#include "nef/construct/mesh_faces.h"

namespace nef {

Polyhedron from_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  if (options.as_surface) return from_surface(mesh, MeshSurface(mesh), options, messages);
  if (mesh.face_count() == 0) throw InputError("the mesh has no faces, so it bounds no solid");
  const MeshSurface surface(mesh);
  bool touching = false;
  if (options.check) {
    for (const MeshProblem& problem : check_mesh(mesh, surface, {.max_per_kind = 1, .self_intersections = true})) {
      if (!problem.legal) throw InputError(problem.text);
      if (problem.kind == MeshProblemKind::kTouching) touching = true;
    }
  }
  if (touching) {
    // Faces meet in points that are no vertices of both; the union of the faces finds these. By parity, cavities stay
    // cavities, however their faces are oriented.
    return Polyhedron(fill_by_parity(from_surface(mesh, surface, options, messages).complex()));
  }
  MeshFaces faces(mesh, surface, options, messages);
  Complex complex = faces.solid(false);
  if (complex.vertex_count() > 0 && complex.volumes[0].mark == 1) {
    if (messages != nullptr) messages->push_back("the faces were oriented inward and have been turned over");
    complex = faces.solid(true);
  }
  return Polyhedron(std::move(complex));
}

}  // namespace nef
