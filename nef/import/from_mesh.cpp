// SPDX-License-Identifier: Apache-2.0
//
// Meshes to solids, in three steps of which each takes what the one before has made: mesh -> checked surface -> solid.
// The check merges equal vertices and cuts faces into triangles; a clean surface becomes a solid by drawing each
// vertex's sphere map from the corners of the faces around it, one in contact by winding numbers.
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/base/union_find.h"
#include "nef/construct/construct.h"
#include "nef/import/checked_surface.h"
#include "nef/import/fill.h"
#include "nef/import/from_surface.h"
#include "nef/import/mesh_faces.h"
#include "nef/import/try_from_mesh.h"
#include "nef/polyhedron.h"

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

// The surface is gone before there is a solid.
std::variant<Complex, Defect> try_solid(CheckedSurface& checked, const MeshOptions& options, Messages* messages) {
  SolidFaces faces = solid_faces(checked, options, messages);
  checked.release();
  return try_make_solid(std::move(faces), SolidMarks{1, 1, 0}, options.monitor);
}

[[noreturn]] void refuse_components(const Mesh& mesh, const Monitor& monitor) {
  std::string list;
  for (const std::uint32_t f : first_faces(mesh, MeshSurface(mesh, monitor)))
    list += (list.empty() ? "" : ", ") + std::to_string(f);
  throw InputError("components of the mesh (which begin at faces " + list.substr(0, 60) +
                   ") contradict each other: one is turned like the one around it, or not like those beside it; "
                   "turn its faces over");
}

// Of a surface without contacts: only its components may not fit together.
Polyhedron solid_of_clean(CheckedSurface&& checked, const MeshOptions& options, Messages* messages) {
  std::variant<Complex, Defect> made = try_solid(checked, options, messages);
  if (Complex* complex = std::get_if<Complex>(&made)) return Polyhedron(std::move(*complex));
  Defect& defect = std::get<Defect>(made);
  if (defect.kind != Defect::Kind::kMarks) throw detail::BrokenInvariant(std::move(defect));
  refuse_components(checked.mesh(), options.monitor);
}

// Of a surface whose contacts nobody has looked for: nothing if it is not as clean as was promised.
std::optional<Polyhedron> solid_of_promised(CheckedSurface&& checked, const MeshOptions& options, Messages* messages) {
  try {
    std::variant<Complex, Defect> made = try_solid(checked, options, messages);
    if (Complex* complex = std::get_if<Complex>(&made)) return Polyhedron(std::move(*complex));
  } catch (const InputError&) {
    // The whole check says it better.
  }
  return std::nullopt;
}

// Faces meet in points that are no vertices of both; the union of the faces finds these.
Polyhedron solid_in_contact(const CheckedSurface& checked, const MeshOptions& options, Messages* messages) {
  return fill_by_winding(from_surface(checked.mesh(), checked.surface(), SurfaceUse::kBorder, options, messages),
                         checked.mesh(), checked.surface(), messages, options.monitor);
}

void note_faces_without_area(const CheckedSurface& checked, Messages* messages) {
  const std::size_t count = checked.faces_without_area();
  if (count == 0 || messages == nullptr) return;
  messages->push_back(std::to_string(count) + (count == 1 ? " face" : " faces") + " without area left out");
}

Polyhedron solid(CheckedSurface&& checked, const MeshOptions& options, Messages* messages) {
  note_faces_without_area(checked, messages);
  return checked.in_contact() ? solid_in_contact(checked, options, messages)
                              : solid_of_clean(std::move(checked), options, messages);
}

// Without the search for contacts, if that is enough.
std::optional<Polyhedron> promised_solid(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  CheckedSurface checked(mesh, CheckedSurface::Extent::kNoCrossings, options.monitor);
  if (checked.in_contact()) return std::nullopt;
  return solid_of_promised(std::move(checked), options, messages);
}

// An empty mesh is how files hold the empty set; vertices that no face uses are no set at all.
Polyhedron without_faces(const Mesh& mesh, Messages* messages) {
  if (!mesh.vertices.empty()) {
    throw InputError("the mesh has " + std::to_string(mesh.vertices.size()) +
                     (mesh.vertices.size() == 1 ? " vertex" : " vertices") +
                     " but no faces: nothing tells what it bounds");
  }
  if (messages != nullptr) messages->emplace_back("the mesh has no faces: it is the empty set");
  return {};
}

}  // namespace

Polyhedron from_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  if (mesh.face_count() == 0) return without_faces(mesh, messages);
  if (options.as_surface) {
    return from_surface(mesh, MeshSurface(mesh, options.monitor), SurfaceUse::kSet, options, messages);
  }
  Messages notes;
  std::optional<Polyhedron> result;
  if (!options.check) result = promised_solid(mesh, options, &notes);
  if (!result) {
    notes.clear();
    result = solid(CheckedSurface(mesh, CheckedSurface::Extent::kAll, options.monitor), options, &notes);
  }
  if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
  return *std::move(result);
}

std::variant<Polyhedron, MeshRefusal> try_from_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  try {
    return from_mesh(mesh, options, messages);
  } catch (const InputError& error) {
    return MeshRefusal{error.what()};
  }
}

}  // namespace nef
