// SPDX-License-Identifier: Apache-2.0
#include "apps/studio/pages/kept_set.h"

#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_texture.h"

namespace nef::studio {
namespace {

// An image beside the file would be a second file, for whose name nobody has asked.
bool holds_texture(const MeshFormat& format) {
  return format.has(kTexture) && has_image_inside(std::string(format.extension));
}

bool holds_vertex_colors(const MeshFormat& format) { return format.has(kVertexColors); }

// Whether colours go to a file of this extension; a line if not.
bool suits(const std::string& path, bool (*holds)(const MeshFormat&), Messages& messages) {
  const MeshFormat* format = find_mesh_format(lower_extension(path));
  if (format != nullptr && holds(*format)) return true;
  messages.push_back("the file has no colours: " + mesh_format_names(holds, "and") + " store them");
  return false;
}

}  // namespace

void KeptSet::write(const std::string& path, PolyhedronWriteOptions options, Messages& messages) const {
  const Monitor monitor = options.monitor;
  Messages of_colors;  // the writer may add notes to `messages` meanwhile
  if (colors_.vertices && suits(path, holds_vertex_colors, messages)) {
    options.vertex_colors = [this, &monitor, &of_colors](const Mesh& mesh) {
      return colors_.vertices(mesh, monitor, of_colors);
    };
  }
  if (colors_.texture && suits(path, holds_texture, messages)) {
    options.texture = [this, &monitor, &of_colors](const Mesh& mesh) {
      return colors_.texture(mesh, monitor, of_colors);
    };
  }
  write_polyhedron(path, whole(monitor), options, &messages);
  messages.insert(messages.end(), of_colors.begin(), of_colors.end());
}

}  // namespace nef::studio
