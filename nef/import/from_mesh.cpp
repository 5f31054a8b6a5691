// SPDX-License-Identifier: Apache-2.0
//
// Meshes to solids, in three steps of which each takes what the one before has made: mesh -> checked surface -> solid.
// The check merges equal vertices and cuts faces into triangles; a clean surface becomes a solid by drawing each
// vertex's sphere map from the corners of the faces around it, one in contact by winding numbers.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/import/checked_surface.h"
#include "nef/import/contact_groups.h"
#include "nef/import/from_surface.h"
#include "nef/import/mesh_faces.h"
#include "nef/import/repair.h"
#include "nef/import/repair/fill.h"
#include "nef/import/resolve_mesh.h"
#include "nef/import/split_faces.h"
#include "nef/import/try_from_mesh.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

// The surface is gone before there is a solid.
std::variant<Complex, Defect> try_solid(CheckedSurface& checked, const MeshOptions& options, Messages* messages) {
  SolidFaces faces = solid_faces(checked, options, messages);
  checked.release();
  return try_make_solid(std::move(faces), SolidMarks{1, 1, 0}, options.monitor);
}

[[noreturn]] void refuse_components(const Mesh& mesh, const Monitor& monitor) {
  std::string list;
  const std::vector<std::uint32_t> components = face_components(mesh, MeshSurface(mesh, monitor));
  for (std::uint32_t f = 0; f < components.size(); ++f) {
    if (components[f] == f) list += (list.empty() ? "" : ", ") + std::to_string(f);
  }
  throw InputError("components of the mesh (which begin at faces " + list.substr(0, 60) +
                   ") contradict each other: one is oriented like the component around it, or unlike those beside it; "
                   "flip its faces" +
                   advice_to_unite());
}

// Nothing if the components do not fit together.
std::optional<Polyhedron> solid_of_clean(CheckedSurface& checked, const MeshOptions& options, Messages* messages) {
  std::variant<Complex, Defect> made = try_solid(checked, options, messages);
  if (Complex* complex = std::get_if<Complex>(&made)) return Polyhedron(std::move(*complex));
  Defect& defect = std::get<Defect>(made);
  if (defect.kind != Defect::Kind::kMarks) throw detail::BrokenInvariant(std::move(defect));
  return std::nullopt;
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

Covering covering_for(Crossings rule) {
  switch (rule) {
    case Crossings::kOdd:
      return Covering::kParity;
    case Crossings::kOutside:
    case Crossings::kGuess:
      return Covering::kAny;
    case Crossings::kRefuse:
    case Crossings::kUnion:
    case Crossings::kNonzero:
      break;
  }
  return Covering::kSigned;
}

void note_faces_left_out(const CheckedSurface& checked, Messages* messages) {
  if (messages == nullptr) return;
  if (const std::size_t count = checked.faces_without_area(); count > 0) {
    messages->push_back(counted(count, "face", "faces") + " without area left out");
  }
  if (const std::size_t count = checked.cancelled_faces(); count > 0) {
    messages->push_back(counted(count, "face", "faces") + " back to back with others left out: they enclose nothing");
  }
}

// By the winding numbers of the volumes between the faces.
ResolvedMesh arranged(const Mesh& mesh, CheckedSurface::Found found, const FillOptions& fill,
                      const MeshOptions& options, Messages* messages) {
  if (const std::optional<Mesh> split = split_faces(mesh, *found.surface, found.contacts)) {
    found.surface = std::make_unique<const MeshSurface>(*split, options.monitor);
    found.contacts = face_contacts(*found.surface, SurfaceContacts(*found.surface, options.monitor));
    return arranged(*split, std::move(found), fill, options, messages);
  }
  FilledMesh filled = fill_by_winding(
      arrange_faces(mesh, std::move(found.surface), found.contacts, fill.covering, options, messages), mesh, fill);
  ResolvedMesh result;
  result.is_arranged = true;
  result.crossing_pairs = count_crossings(found.contacts);
  // Without a rule, a mesh may be inside out as a whole and nothing else.
  result.inside_out = fill.inside_out || (fill.rule == Crossings::kRefuse && filled.lowest < 0);
  if (result.inside_out && messages != nullptr) messages->emplace_back(kTurnedOver);
  result.set = std::move(filled.set);
  result.lowest = result.inside_out && !fill.inside_out ? -filled.highest : filled.lowest;
  result.highest = result.inside_out && !fill.inside_out ? -filled.lowest : filled.highest;
  result.volumes = std::move(filled.volumes);
  return result;
}

// Of a solid by itself.
WindingVolume measured(const Polyhedron& set, Measure measure, const MeshOptions& options) {
  WindingVolume result;
  for (const Volume& each : set.complex().volumes) result.parts += each.mark != 0 ? 1 : 0;
  if (measure == Measure::kExactly) {
    result.volume = volume(set).value();
  } else {
    result.measured = approximate_volume(set, options.monitor);
  }
  return result;
}

}  // namespace

ResolvedMesh resolve_mesh(CheckedSurface&& checked, const MeshOptions& options, Messages* messages, Measure measure) {
  checked.require_legal(options.monitor);
  note_faces_left_out(checked, messages);
  const FillOptions fill{.rule = options.crossings,
                         .covering = covering_for(options.crossings),
                         .inside_out = checked.inside_out() && options.crossings != Crossings::kRefuse,
                         .measure = measure,
                         .monitor = options.monitor};
  if (checked.in_contact()) {
    const Mesh& mesh = checked.mesh();
    const bool is_unpaired = checked.is_unpaired();
    ResolvedMesh result = arranged(mesh, std::move(checked).take(), fill, options, messages);
    result.is_unpaired = is_unpaired;
    return result;
  }
  ResolvedMesh result;
  result.inside_out = checked.inside_out();
  Messages notes;
  std::optional<Polyhedron> clean = solid_of_clean(checked, options, &notes);
  if (clean) {
    if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
    result.set = *std::move(clean);
    if (measure != Measure::kNot) result.volumes[1] = measured(result.set, measure, options);
    return result;
  }
  if (options.crossings == Crossings::kRefuse) refuse_components(checked.mesh(), options.monitor);
  return arranged(checked.mesh(), {std::make_unique<const MeshSurface>(checked.mesh(), options.monitor), {}}, fill,
                  options, messages);
}

namespace {

// Without the search for contacts, if that is enough.
std::optional<Polyhedron> promised_solid(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  CheckedSurface checked(mesh, CheckedSurface::Extent::kNoCrossings, options.crossings, options.monitor);
  checked.require_legal(options.monitor);
  if (checked.in_contact()) return std::nullopt;
  return solid_of_promised(std::move(checked), options, messages);
}

// An empty mesh is how files hold the empty set; vertices that no face uses are no set at all.
Polyhedron without_faces(const Mesh& mesh, Messages* messages) {
  if (!mesh.vertices.empty()) {
    throw InputError("the mesh has " + std::to_string(mesh.vertices.size()) +
                     (mesh.vertices.size() == 1 ? " vertex" : " vertices") + " but no faces, so it bounds nothing");
  }
  if (messages != nullptr) messages->emplace_back("the mesh has no faces, so it is the empty set");
  return {};
}

}  // namespace

Polyhedron from_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  if (mesh.face_count() == 0) return without_faces(mesh, messages);
  if (options.as_surface) {
    return from_surface(mesh, MeshSurface(mesh, options.monitor), options, messages);
  }
  if (options.close_percent > 0) return repaired_solid(mesh, options, messages);
  Messages notes;
  std::optional<Polyhedron> result;
  if (!options.check) result = promised_solid(mesh, options, &notes);
  if (!result) {
    notes.clear();
    ResolvedMesh resolved = resolve_mesh(mesh, options, &notes, Measure::kNot);
    if (std::string decided = note_about(resolved, options.crossings); !decided.empty()) {
      notes.push_back(std::move(decided));
    }
    result = std::move(resolved.set);
  }
  if (messages != nullptr) messages->insert(messages->end(), notes.begin(), notes.end());
  return *std::move(result);
}

std::string note_about(const ResolvedMesh& resolved, Crossings rule) {
  if (rule == Crossings::kRefuse) return "";
  const std::size_t pairs = resolved.crossing_pairs;
  const bool is_guess = rule == Crossings::kGuess && resolved.is_arranged;
  if (pairs == 0 && resolved.lowest >= 0 && resolved.highest <= 1 && !is_guess && !resolved.is_unpaired) return "";
  const std::string what = pairs > 0              ? crossing_text(pairs)
                           : is_guess             ? "the mesh may have holes"
                           : resolved.is_unpaired ? "edges with an odd number of faces"
                                                  : "the mesh encloses parts of space several times or inside out";
  return what + "; selected " + taken_by(rule);
}

ResolvedMesh resolve_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages, Measure measure) {
  if (mesh.face_count() == 0) {
    ResolvedMesh empty;
    empty.set = without_faces(mesh, messages);
    return empty;
  }
  return resolve_mesh(CheckedSurface(mesh, CheckedSurface::Extent::kAll, options.crossings, options.monitor), options,
                      messages, measure);
}

std::variant<Polyhedron, MeshRefusal> try_from_mesh(const Mesh& mesh, const MeshOptions& options, Messages* messages) {
  try {
    return from_mesh(mesh, options, messages);
  } catch (const InputError& error) {
    return MeshRefusal{error.what()};
  }
}

}  // namespace nef
