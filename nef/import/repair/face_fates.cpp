// SPDX-License-Identifier: Apache-2.0
#include "nef/import/repair/face_fates.h"

#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/mesh_piece.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {
namespace {

Rational3 middle(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return mean_of<Rational>(std::array{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
}

}  // namespace

const char* name(FaceFate fate) {
  constexpr std::array<const char*, kAllFates.size()> kNames{"kept", "turned",  "cut",  "inside",
                                                             "copy", "no_area", "added"};
  return kNames[static_cast<std::size_t>(fate)];
}

std::vector<FaceFate> fates_by_rule(const Mesh& mesh, std::span<const FaceContact> contacts, const Polyhedron& solid,
                                    const Monitor& monitor) {
  const MeshSurface surface(mesh, monitor);
  std::vector<FaceFate> result(mesh.face_count(), FaceFate::kKept);
  for (const FaceContact& contact : contacts) {
    if (contact.kind == SurfaceContacts::Kind::kTouch) continue;
    result[contact.f] = result[contact.g] = FaceFate::kCut;
  }
  for (std::uint32_t f = 0; f < result.size(); ++f) {
    if (surface.defects[f] == FaceDefect::kCrossesItself) result[f] = FaceFate::kCut;
    if (result[f] == FaceFate::kCut) continue;
    const std::uint32_t first = surface.triangle_begin[f];
    const bool has_area = surface.defects[f] == FaceDefect::kNone && first != surface.triangle_begin[f + 1];
    if (!has_area || locate(solid, middle(mesh, surface.triangles[first]), monitor).kind == Location::Kind::kVolume) {
      result[f] = FaceFate::kInside;
    }
  }
  return result;
}

CutPieces pieces_of_cut_faces(const Mesh& mesh, const std::vector<FaceFate>& fates, const Polyhedron& solid,
                              const Monitor& monitor) {
  MeshPiece cut(mesh.vertices);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (fates[f] == FaceFate::kCut) cut.push(mesh.face(f));
  }
  const Mesh faces = cut.take();
  if (faces.face_count() == 0) return {};
  const Polyhedron surface = from_mesh(faces, {.as_surface = true, .monitor = monitor});
  const Polyhedron border = boundary(solid, monitor);
  return {intersect(surface, border, monitor), subtract(surface, border, monitor)};
}

}  // namespace nef
