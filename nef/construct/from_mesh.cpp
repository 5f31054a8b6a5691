// SPDX-License-Identifier: Apache-2.0
//
// Meshes to solids: check, merge equal vertices, find the plane of every face, then draw each
// vertex's sphere map from the corners of the faces around it.
#include <string>

#include "nef/base/contradiction.h"
#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/construct/construct.h"
#include "nef/construct/fill.h"
#include "nef/construct/from_surface.h"
#include "nef/construct/mesh_check.h"
#include "nef/construct/mesh_faces.h"

namespace nef {
namespace {

// The first face of each connected component of the surface.
std::vector<std::uint32_t> first_faces(const Mesh& mesh, const MeshSurface& surface) {
  UnionFind places(mesh.vertices.size());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (const std::uint32_t v : mesh.face(f)) places.unite(surface.place[v], surface.place[mesh.face(f)[0]]);
  }
  std::vector<bool> seen(mesh.vertices.size(), false);
  std::vector<std::uint32_t> result;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face(f).empty()) continue;
    const std::uint32_t component = places.find(surface.place[mesh.face(f)[0]]);
    if (!seen[component]) result.push_back(f);
    seen[component] = true;
  }
  return result;
}

Polyhedron solid(const Mesh& mesh, const MeshSurface& surface, const MeshOptions& options, Messages* messages) {
  MeshFaces faces(mesh, surface, options, messages);
  Complex complex = faces.solid(false);
  if (complex.vertex_count() > 0 && complex.volumes[0].mark == 1) {
    if (messages != nullptr) messages->push_back("the faces were oriented inward and have been turned over");
    complex = faces.solid(true);
  }
  return Polyhedron(std::move(complex));
}

}  // namespace

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
  try {
    return solid(mesh, surface, options, messages);
  } catch (const ContradictingMarks&) {
    std::string list;
    for (const std::uint32_t f : first_faces(mesh, surface)) list += (list.empty() ? "" : ", ") + std::to_string(f);
    throw InputError("the components of the mesh (which begin at faces " + list.substr(0, 60) +
                     ") contradict each other: one is turned like the one around it, or not like those beside it; "
                     "turn its faces over");
  }
}

}  // namespace nef
