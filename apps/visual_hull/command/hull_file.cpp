// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/hull_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/visual_hull/color/vertex_colors.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/polyhedron_file.h"

namespace visual_hull {

namespace {

void need_mesh(const Arguments& a, const std::string& option, bool (*suits)(const std::string&), const char* formats) {
  if (a.output.empty()) throw nef::InputError(option + " writes a mesh: give it a name with -o");
  if (suits(nef::lower_extension(a.output))) return;
  throw nef::InputError(option + ": " + a.output + " cannot hold that; " + formats + " can");
}

std::vector<Color> colors_of(const nef::Mesh& mesh, const Result& result, const Arguments& a, nef::Messages& messages,
                             const nef::Monitor& monitor) {
  VertexColors found = vertex_colors(mesh, result.views, result.origin, a.threads, monitor);
  if (found.unseen > 0) {
    messages.push_back(fmt::format("{} of {} vertices are seen by no view: they have the colours of their neighbours",
                                   found.unseen, found.colors.size()));
  }
  const bool masks = std::all_of(result.views.begin(), result.views.end(), [](const ViewResult& view) {
    const std::string folder = view.image.parent_path().filename().string();
    return (folder == "masks" || folder == "silhouettes") && photograph_of(view.image) == view.image;
  });
  if (masks) {
    messages.push_back("the colours are those of the masks: no photographs of their names are in images/ beside them");
  }
  return std::move(found.colors);
}

}  // namespace

void check_output(const Arguments& a) {
  const auto is_mesh = [](const std::string& extension) { return extension != "nef" && extension != "nef3"; };
  const auto names_vertices = [](const std::string& extension) {
    return extension != "nef" && extension != "nef3" && extension != "stl";
  };
  if (a.decimate != 0) need_mesh(a, "--decimate", is_mesh, "OFF, OBJ, STL, PLY, GLB and 3MF");
  if (a.manifold) need_mesh(a, "--manifold", names_vertices, "OFF, OBJ, PLY, GLB and 3MF");
  if (a.color) need_mesh(a, "--color", nef::has_vertex_colors, "PLY and GLB");
}

WrittenHull write_hull(const std::string& path, const Result& result, const Arguments& a, nef::Messages& messages,
                       const nef::Monitor& monitor) {
  nef::PolyhedronWriteOptions format;
  format.exact = a.exact;
  format.binary = a.binary;
  format.text = a.text;
  format.manifold = a.manifold;
  format.lenient = a.mesh_file.lenient;
  format.recenter = a.mesh_file.recenter;
  format.threads = a.threads;
  format.monitor = monitor;
  if (a.color) {
    format.vertex_colors = [&](const nef::Mesh& mesh) { return colors_of(mesh, result, a, messages, monitor); };
  }
  WrittenHull written;
  if (a.decimate == 0) {
    written.file = nef::write_polyhedron(path, result.hull, format, &messages);
  } else {
    written.decimated = nef::decimate(result.hull, a.decimate, monitor);
    const nef::Messages& notes = written.decimated->notes;
    messages.insert(messages.end(), notes.begin(), notes.end());
    written.file = nef::write_solid_mesh(path, written.decimated->mesh, false, format, &messages);
  }
  return written;
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
