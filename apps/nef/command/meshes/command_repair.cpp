// SPDX-License-Identifier: Apache-2.0
//
// nef repair
//
// Reads the mesh, repairs it (nef/import/repair.h says how), writes the solid that it bounds then, or the mesh if no
// rule for crossings had to decide, and reports what was done: in lines, as JSON, and as a file with the faces that
// came in.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "apps/nef/command/commands.h"
#include "apps/program/common_options.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/export/to_mesh.h"
#include "nef/import/repair.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_parts.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/polyhedron_file.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef {
namespace {

// Whether the output holds sets and no meshes.
bool is_set_file(const Session& session) {
  const std::string format = session.write_options().format;
  return is_set_extension(format.empty() ? lower_extension(session.output) : format);
}

// Nothing of a mesh that bounds no solid, unless it is to be written as it is.
void store(Session& session, const RepairedMesh& repaired) {
  const bool solid = repaired.problem.empty();
  if (repaired.resolved || (solid && is_set_file(session))) return session.store(repaired.set);
  if (solid || session.mesh_file.lenient) session.store_mesh(repaired.mesh, solid);  // what rounding does is checked
}

// What the rule for crossings decided; null if nothing.
Json crossings_json(const RepairedMesh& repaired, Crossings rule) {
  if (!repaired.resolved) return nullptr;
  Json volumes = Json::array();
  for (const auto& [winding, entry] : repaired.resolved->volumes) {
    if (entry.parts == 0) continue;
    volumes.push_back({{"winding_number", winding},
                       {"parts", entry.parts},
                       {"volume", entry.measured.value},
                       {"volume_error", entry.measured.error},
                       {"taken", is_taken(rule, winding)}});
  }
  return {{"rule", name(rule)},
          {"pairs", repaired.resolved->crossing_pairs},
          {"signed_volume", repaired.signed_volume.value},
          {"signed_volume_error", repaired.signed_volume.error},
          {"volumes", volumes}};
}

Json holes_json(const RepairedMesh& repaired) {
  return {{"count", repaired.holes},
          {"flat", repaired.flat_holes},
          {"lid_share", std::isfinite(repaired.lid_share) ? Json(repaired.lid_share) : Json(nullptr)},
          {"closed", repaired.has_lids}};
}

// How many faces have each fate.
Json counts_json(const FaceRecord& record) {
  Json result = Json::object();
  for (const FaceFate fate : kAllFates) {
    result[name(fate)] = std::count(record.fates.begin(), record.fates.end(), fate);
  }
  return result;
}

Json numbers_json(const FaceRecord& record) {
  Json result = Json::object();
  for (const FaceFate fate : kAllFates) result[name(fate)] = Json::array();
  for (std::size_t f = 0; f < record.fates.size(); ++f) result[name(record.fates[f])].push_back(f);
  return result;
}

Json numbers_of_parts_json(const FaceGroups& parts) {
  Json result = Json::object();
  const std::vector<std::vector<std::uint32_t>> faces = faces_by_group(parts);
  for (std::size_t i = 0; i < faces.size(); ++i) result[parts.names[i]] = faces[i];
  return result;
}

// A mesh whose faces are in groups.
struct GroupedFaces {
  Mesh mesh;
  FaceGroups groups;

  void push(std::span<const std::uint32_t> face, const std::string& group) {
    const auto at = std::find(groups.names.begin(), groups.names.end(), group);
    groups.of_face.push_back(static_cast<std::uint32_t>(at - groups.names.begin()));
    if (at == groups.names.end()) groups.names.push_back(group);
    mesh.push_face(face);
  }

  // All facets of a two-dimensional set.
  void push(const Polyhedron& set, const std::string& group, const Monitor& monitor) {
    MeshExportOptions polygons;
    polygons.keep_polygons = polygons.lower_dimensional = true;
    const Mesh more = to_mesh(set, polygons, monitor).mesh;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (std::size_t f = 0; f < more.face_count(); ++f) {
      std::vector<std::uint32_t> face(more.face(f).begin(), more.face(f).end());
      for (std::uint32_t& v : face) v += first;
      push(face, group);
    }
  }
};

// The mesh that came in, and the faces that were added, in groups by what became of them; of those that were cut the
// pieces. Or the numbers of the faces of each group.
void write_record(const std::string& path, const Mesh& input, const FaceRecord& record, const FaceGroups& parts,
                  const Monitor& monitor) {
  const std::string extension = lower_extension(path);
  if (extension == "json") {
    Json text{{"faces", input.face_count()}, {"fates", numbers_json(record)}};
    if (!parts.none()) text["parts"] = numbers_of_parts_json(parts);
    return write_file(path, text.dump() + "\n");
  }
  const MeshFormat* format = find_mesh_format(extension);
  if (format == nullptr || !format->has(kFaceGroups)) {
    throw UnsupportedError(path + ": --record writes groups of faces: " + mesh_format_names(kFaceGroups) +
                           "; or their numbers: JSON");
  }
  GroupedFaces all;
  for (const FaceFate fate : kAllFates) {
    all.groups.names.emplace_back(name(fate));
    if (fate == FaceFate::kCut) all.groups.names.emplace_back("cut_off");
  }
  all.mesh.vertices = input.vertices;
  const bool in_pieces = !record.pieces.kept.is_empty() || !record.pieces.dropped.is_empty();
  for (std::size_t f = 0; f < record.fates.size(); ++f) {
    if (in_pieces && record.fates[f] == FaceFate::kCut) continue;
    all.push(f < input.face_count() ? input.face(f) : record.added[f - input.face_count()], name(record.fates[f]));
  }
  all.push(record.pieces.kept, name(FaceFate::kCut), monitor);
  all.push(record.pieces.dropped, "cut_off", monitor);
  write_mesh(path, all.mesh, {.groups = std::move(all.groups)});
}

// The mesh of a file, and which of its named parts each face belongs to; no groups if it has none.
Mesh read_in_parts(const std::string& path, FaceGroups& parts) {
  const PartPath at = part_path(path);
  if (is_set_extension(lower_extension(at.file))) {
    throw InputError(path + ": only meshes are repaired; a set in this format needs no repair");
  }
  if (!at.part.empty() || find_mesh_format(lower_extension(at.file)) == nullptr) return read_mesh(path);
  MeshParts named;
  Mesh mesh = read_mesh(read_file(path), path, &named);
  if (!named.empty()) parts = groups_of_parts(mesh, named);
  return mesh;
}

// How many faces of a part have each fate.
using CountsOfPart = std::array<std::size_t, kAllFates.size()>;

std::vector<CountsOfPart> counts_by_part(const FaceRecord& record, const FaceGroups& parts) {
  std::vector<CountsOfPart> result(parts.names.size());
  for (std::size_t f = 0; f < parts.of_face.size(); ++f) {
    ++result[parts.of_face[f]][static_cast<std::size_t>(record.fates[f])];
  }
  return result;
}

// Null without named parts or a record; the faces of none have the name "".
Json parts_json(const std::vector<CountsOfPart>& counts, const FaceGroups& parts) {
  if (counts.empty()) return nullptr;
  Json result = Json::object();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (const FaceFate fate : kAllFates) {
      if (fate != FaceFate::kAdded) result[parts.names[i]][name(fate)] = counts[i][static_cast<std::size_t>(fate)];
    }
  }
  return result;
}

// A line for each named part of which no face is left in the boundary.
std::vector<std::string> lines_about_lost_parts(const std::vector<CountsOfPart>& counts, const FaceGroups& parts) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto of = [&](FaceFate fate) { return counts[i][static_cast<std::size_t>(fate)]; };
    if (parts.names[i].empty() || of(FaceFate::kKept) + of(FaceFate::kTurned) + of(FaceFate::kCut) > 0) continue;
    result.push_back("no face remains of the part " + in_quotes(parts.names[i]) + ": " +
                     (of(FaceFate::kInside) > 0 ? "it lies inside" : "its faces are copies or have no area"));
  }
  return result;
}

// The area of all faces that were cut, and of what is left of them.
Json cut_json(const CutPieces& pieces, const Monitor& monitor) {
  const double kept = approximate_area(pieces.kept, monitor).value;
  return {{"area", kept + approximate_area(pieces.dropped, monitor).value}, {"kept", kept}};
}

struct RepairFlags {
  RepairOptions options;
  std::string record;
};

void add_repair_options(CLI::App& command, Session&, RepairFlags& flags) {
  command.add_flag("--fill-holes", flags.options.fill_holes, "Close planar holes with a face");
  add_close_option(command, flags.options.close_percent);
  add_crossings_option(command, flags.options.crossings);
  command
      .add_option("--record", flags.record,
                  "Write the input mesh with its faces grouped by what happened to them: kept, turned, cut and cut_off "
                  "(pieces of faces that cross others), inside (removed), copy, no_area and added (.obj; as colours in "
                  ".off, .ply and .glb); or only the numbers of the faces (.json)")
      ->type_name("FILE");
}

void run_repair(Session& session, RepairFlags& flags) {
  RepairOptions& options = flags.options;
  options.record = !flags.record.empty();
  FaceGroups parts;
  const Mesh input = read_in_parts(session.input, parts);
  RepairedMesh repaired = repair_mesh(input, options, session.monitor);
  std::vector<CountsOfPart> counts;
  if (options.record) {
    write_record(flags.record, input, repaired.record, parts, session.monitor);
    counts = counts_by_part(repaired.record, parts);
    for (std::string& line : lines_about_lost_parts(counts, parts)) repaired.done.push_back(std::move(line));
  }
  const bool solid = repaired.problem.empty();
  store(session, repaired);
  for (const std::string& line : repaired.done) session.say(line);
  session.note_all(repaired.notes);
  session.say(
      solid ? (repaired.done.empty() ? "nothing to repair" : "the mesh now bounds a solid")
            : "still not a valid solid: " + repaired.problem + advice_about(repaired, options.close_percent) +
                  (session.mesh_file.lenient ? "" : "; no file was written (--lenient writes the mesh as it is)"));
  session.exit_code = solid ? kYes : kNo;
  if (!session.json) return;
  session.print("repair", {{"ok", solid},
                           {"done", repaired.done},
                           {"holes", holes_json(repaired)},
                           {"crossings", crossings_json(repaired, options.crossings)},
                           {"faces", options.record ? counts_json(repaired.record) : Json(nullptr)},
                           {"parts", parts_json(counts, parts)},
                           {"cut", options.record ? cut_json(repaired.record.pieces, session.monitor) : Json(nullptr)},
                           {"problem", solid ? Json(nullptr) : Json(repaired.problem)}});
}

}  // namespace

Commands repair_commands() {
  return {with_flags<RepairFlags>(
      {.name = "repair",
       .description = "Repair a mesh so that it bounds a solid, and report each change. Exit code 0 if it then does, 1 "
                      "if not (and a file is written only with --lenient)",
       .operands = "File of the mesh",
       .reads_meshes = false,
       .output = Output::kRequired},
      add_repair_options, run_repair)};
}

}  // namespace nef
