// SPDX-License-Identifier: Apache-2.0
//
// Meshes to solids: check, merge equal vertices, find the plane of every face, then draw each
// vertex's sphere map from the corners of the faces around it.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/union_find.h"
#include "nef/construct/construct.h"
#include "nef/import/fill.h"
#include "nef/import/from_surface.h"
#include "nef/import/mesh_faces.h"
#include "nef/import/try_from_mesh.h"
#include "nef/mesh/mesh_check.h"
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

// The surface of the mesh is as large as what is made of it. Whoever is done with it hands it on, so that it is gone
// before there is a solid.
using SharedSurface = std::shared_ptr<const MeshSurface>;

std::variant<Complex, Defect> try_solid(const Mesh& mesh, SharedSurface surface, const MeshOptions& options,
                                        Messages* messages) {
  constexpr SolidMarks kMarks{1, 1, 0};
  SolidFaces faces = MeshFaces(mesh, *surface, options, messages).take(false);
  surface.reset();
  std::variant<Complex, Defect> made = try_make_solid(std::move(faces), kMarks, options.monitor);
  const Complex* complex = std::get_if<Complex>(&made);
  if (complex == nullptr || complex->vertex_count() == 0 || complex->volumes[kOuterVolume].mark != 1) return made;
  if (messages != nullptr) messages->push_back(kTurnedOver);
  return try_make_solid(MeshFaces(mesh, MeshSurface(mesh, options.monitor), options, messages).take(true), kMarks,
                        options.monitor);
}

// Of a mesh that has been checked: only its components may not fit together.
Polyhedron solid(const Mesh& mesh, SharedSurface surface, const MeshOptions& options, Messages* messages) {
  std::variant<Complex, Defect> made = try_solid(mesh, std::move(surface), options, messages);
  if (Complex* complex = std::get_if<Complex>(&made)) return Polyhedron(std::move(*complex));
  Defect& defect = std::get<Defect>(made);
  if (defect.kind != Defect::Kind::kMarks) throw detail::BrokenInvariant(std::move(defect));
  std::string list;
  for (const std::uint32_t f : first_faces(mesh, MeshSurface(mesh, options.monitor)))
    list += (list.empty() ? "" : ", ") + std::to_string(f);
  throw InputError("components of the mesh (which begin at faces " + list.substr(0, 60) +
                   ") contradict each other: one is turned like the one around it, or not like those beside it; "
                   "turn its faces over");
}

// Of a mesh that has not: nothing if it is not as clean as was promised.
std::optional<Polyhedron> unchecked_solid(const Mesh& mesh, SharedSurface surface, const MeshOptions& options,
                                          Messages* messages) {
  try {
    std::variant<Complex, Defect> made = try_solid(mesh, std::move(surface), options, messages);
    if (Complex* complex = std::get_if<Complex>(&made)) return Polyhedron(std::move(*complex));
  } catch (const InputError&) {
    // The checks say it better.
  }
  return std::nullopt;
}

bool has_faces_without_area(const MeshSurface& surface) {
  return std::find(surface.defects.begin(), surface.defects.end(), FaceDefect::kNoArea) != surface.defects.end();
}

void note_faces_without_area(const MeshSurface& surface, Messages* messages) {
  const auto count = std::count(surface.defects.begin(), surface.defects.end(), FaceDefect::kNoArea);
  if (count == 0 || messages == nullptr) return;
  messages->push_back(std::to_string(count) + (count == 1 ? " face" : " faces") + " without area left out");
}

// Faces meet in points that are no vertices of both; the union of the faces finds these.
Polyhedron solid_in_contact(const Mesh& mesh, const MeshSurface& surface, const MeshOptions& options,
                            Messages* messages) {
  return fill_by_winding(from_surface(mesh, surface, SurfaceUse::kBorder, options, messages), mesh, surface, messages,
                         options.monitor);
}

// True if faces meet otherwise than in common vertices and edges. Throws InputError for what no solid has.
bool check(const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor) {
  bool touching = false;
  constexpr MeshCheckOptions kFirst{.max_per_kind = 1, .self_intersections = true};
  for (const MeshProblem& problem : check_mesh(mesh, surface, kFirst, monitor)) {
    if (!problem.legal) throw InputError(problem.text);
    if (problem.kind == MeshProblemKind::kTouching || problem.kind == MeshProblemKind::kDuplicateFace) touching = true;
  }
  return touching;
}

// True if no face is known to be wrong before the surface as a whole is looked at.
bool has_good_faces(const MeshSurface& surface) {
  return std::all_of(surface.defects.begin(), surface.defects.end(),
                     [](FaceDefect defect) { return defect == FaceDefect::kNone; });
}

Polyhedron checked_solid(const Mesh& mesh, SharedSurface surface, const MeshOptions& options, Messages* messages) {
  options.monitor.tell_progress("self-intersections", 0, 0);
  if (options.threads != 1 && has_good_faces(*surface)) {
    // The solid is made while the faces are looked at: hardly any mesh has contacts, and what is made of one that has
    // some is thrown away.
    std::optional<Polyhedron> early;
    Messages notes;
    bool contact = false;
    parallel_calls(options.threads, options.monitor,
                   {[&](const Monitor& own) { contact = check(mesh, *surface, own); },
                    [&](const Monitor& own) {
                      MeshOptions with_own = options;
                      with_own.monitor = own;
                      early = unchecked_solid(mesh, surface, with_own, &notes);
                    }});
    if (contact) return solid_in_contact(mesh, *surface, options, messages);
    if (!early) return solid(mesh, std::move(surface), options, messages);  // which tells what is wrong
    if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
    return *std::move(early);
  }
  // Without a face that has no area, its neighbours meet in parts of edges.
  const bool contact = check(mesh, *surface, options.monitor) || has_faces_without_area(*surface);
  return contact ? solid_in_contact(mesh, *surface, options, messages)
                 : solid(mesh, std::move(surface), options, messages);
}

}  // namespace

Polyhedron from_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  if (options.as_surface) {
    return from_surface(mesh, MeshSurface(mesh, options.monitor), SurfaceUse::kSet, options, messages);
  }
  if (mesh.face_count() == 0) throw InputError("the mesh has no faces, so it bounds no solid");
  options.monitor.tell_progress("faces of the mesh", 0, 0);
  auto surface = std::make_shared<const MeshSurface>(mesh, options.monitor);
  Messages notes;
  note_faces_without_area(*surface, &notes);
  std::optional<Polyhedron> result;
  if (!options.check && !has_faces_without_area(*surface)) {
    const std::size_t before = notes.size();
    result = unchecked_solid(mesh, std::exchange(surface, nullptr), options, &notes);
    if (!result) notes.resize(before);
    if (!result) surface = std::make_shared<const MeshSurface>(mesh, options.monitor);
  }
  // Also if the mesh is not as clean as was promised: the checks say why, or what to do with it.
  if (!result) result = checked_solid(mesh, std::move(surface), options, &notes);
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
