// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/hull_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/visual_hull/color/vertex_colors.h"
#include "apps/visual_hull/command/pictures/overlay.h"
#include "apps/visual_hull/texture/hull_texture.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/polyhedron_file.h"

namespace nef::visual_hull {

namespace {

void need_mesh(const Arguments& a, const std::string& option, bool (*suits)(const nef::MeshFormat&)) {
  if (a.session.output.empty()) throw nef::InputError(option + " writes a mesh: name its file with -o");
  const nef::MeshFormat* format = nef::find_mesh_format(nef::lower_extension(a.session.output));
  if (format != nullptr && suits(*format)) return;
  throw nef::InputError(option + ": " + a.session.output + " cannot store this; " +
                        nef::mesh_format_names(suits, "and") + " can");
}

// Colours and textures are for a mesh, a page or a picture.
void need_surface(const Arguments& a, const std::string& option, bool (*suits)(const nef::MeshFormat&)) {
  const bool shown = !a.page.empty() || !a.picture.empty();
  if (!shown || !a.session.output.empty()) need_mesh(a, option, suits);
}

// A note if there are no photographs beside the masks.
void note_masks(const Result& result, nef::Messages& messages) {
  const bool masks = std::all_of(result.views.begin(), result.views.end(), [](const ViewResult& view) {
    const std::string folder = view.image.parent_path().filename().string();
    return (folder == "masks" || folder == "silhouettes") && photograph_of(view.image) == view.image;
  });
  if (!masks) return;
  messages.push_back(
      "the colours are those of the masks, because images/ beside them has no photographs of the same names");
}

}  // namespace

std::vector<Color> colors_of_hull(const nef::Mesh& mesh, const Result& result, const nef::Monitor& monitor,
                                  nef::Messages& messages) {
  VertexColors found = vertex_colors(mesh, result.views, result.origin, monitor);
  if (found.unseen > 0) {
    messages.push_back(fmt::format("{} of {} vertices are seen by no view and get the colours of their neighbours",
                                   found.unseen, found.colors.size()));
  }
  note_masks(result, messages);
  return std::move(found.colors);
}

nef::MeshTexture texture_of_hull(const nef::Mesh& mesh, const Result& result, const nef::Monitor& monitor,
                                 nef::Messages& messages, TextureFigures* figures) {
  HullTexture found = hull_texture(mesh, result.views, result.origin, monitor);
  if (figures != nullptr) *figures = {found.image.cols, found.image.rows, found.charts, found.unseen};
  if (found.unseen >= 0.001) {
    messages.push_back(fmt::format("{:.1f} % of the surface is seen by no view and gets the colours of its neighbours",
                                   100 * found.unseen));
  }
  note_masks(result, messages);
  return {png_of(found.image), std::move(found.corners)};
}

void check_output(const Arguments& a) {
  using nef::MeshFormat;
  if (a.decimate != 0) need_mesh(a, "--decimate", [](const MeshFormat& /*any*/) { return true; });
  if (a.session.mesh_file.manifold)
    need_mesh(a, "--manifold", [](const MeshFormat& format) { return format.has(nef::kNamedVertices); });
  if (a.color && a.texture) throw nef::InputError("--color and --texture exclude each other: use one of them");
  if (a.color) need_surface(a, "--color", [](const MeshFormat& format) { return format.has(nef::kVertexColors); });
  if (!a.texture) return;
  need_surface(a, "--texture", [](const MeshFormat& format) { return format.has(nef::kTexture); });
  if (a.session.mesh_file.manifold) {
    throw nef::InputError(
        "--texture and --manifold exclude each other: a textured mesh has vertices of its own at seams");
  }
}

WrittenHull write_hull(const std::string& path, const Result& result, const Arguments& a,
                       nef::PolyhedronWriteOptions format, nef::Messages& messages) {
  if (a.color) {
    format.vertex_colors = [&result, &messages, monitor = format.monitor](const nef::Mesh& mesh) {
      return colors_of_hull(mesh, result, monitor, messages);
    };
  }
  WrittenHull written;
  if (a.texture) {
    format.texture = [&result, &messages, &written, monitor = format.monitor](const nef::Mesh& mesh) {
      return texture_of_hull(mesh, result, monitor, messages, &written.texture.emplace());
    };
  }
  if (a.decimate == 0) {
    written.file = nef::write_polyhedron(path, result.hull, format, &messages);
  } else {
    written.decimated = nef::decimate(result.hull, a.decimate, format.monitor);
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

nlohmann::ordered_json texture_json(const TextureFigures& figures) {
  return {{"width", figures.width}, {"height", figures.height}, {"charts", figures.charts}, {"unseen", figures.unseen}};
}

std::string decimation_text(const nef::DecimatedMesh& decimated) {
  return fmt::format("decimated to {} triangles; Hausdorff distance from the hull {:.6g} to {:.6g}",
                     decimated.mesh.face_count(), decimated.distance.low, decimated.distance.high);
}

}  // namespace nef::visual_hull
