// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/hull_file.h"

#include <fmt/format.h>

#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/polyhedron_file.h"

namespace visual_hull {

void check_output(const Arguments& a) {
  if (a.decimate == 0) return;
  if (a.output.empty()) throw nef::InputError("--decimate writes a mesh: give it a name with -o");
  const std::string extension = nef::lower_extension(a.output);
  if (extension == "nef" || extension == "nef3") {
    throw nef::InputError("--decimate writes a mesh, and " + a.output + " is none: off, obj, stl, ply, glb, 3mf");
  }
}

std::optional<nef::DecimatedMesh> write_hull(const std::string& path, const nef::Polyhedron& hull, const Arguments& a,
                                             nef::Messages* messages) {
  if (a.decimate == 0) {
    nef::PolyhedronWriteOptions format;
    format.exact = a.exact;
    format.binary = a.binary;
    format.text = a.text;
    nef::write_polyhedron(path, hull, format, messages);
    return std::nullopt;
  }
  nef::DecimatedMesh decimated = nef::decimate(hull, a.decimate);
  if (messages != nullptr) messages->insert(messages->end(), decimated.notes.begin(), decimated.notes.end());
  nef::write_mesh(path, decimated.mesh, {.exact = a.exact, .binary = a.binary}, messages);
  return decimated;
}

nlohmann::ordered_json decimation_json(const nef::DecimatedMesh& decimated) {
  return {{"triangles", decimated.mesh.face_count()},
          {"vertices", decimated.mesh.vertices.size()},
          {"distance", {{"low", decimated.distance.low}, {"high", decimated.distance.high}}}};
}

std::string decimation_text(const nef::DecimatedMesh& decimated) {
  return fmt::format("decimated to {} triangles; Hausdorff distance from the hull {:.6g} to {:.6g}",
                     decimated.mesh.face_count(), decimated.distance.low, decimated.distance.high);
}

}  // namespace visual_hull
