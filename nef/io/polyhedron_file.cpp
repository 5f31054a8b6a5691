// SPDX-License-Identifier: Apache-2.0
#include "nef/io/polyhedron_file.h"

#include "nef/construct/to_mesh.h"
#include "nef/io/cgal_nef3.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh_reader.h"
#include "nef/io/native_binary.h"
#include "nef/io/native_format.h"

namespace nef {

Polyhedron read_polyhedron(const std::string& path, const MeshOptions& options, Messages* messages) {
  const std::string extension = lower_extension(path);
  if (!is_mesh_extension(extension)) {
    const std::string bytes = read_file(path);
    // Files without a telling extension are known by their first word.
    if (extension == "nef3" || bytes.starts_with("Selective Nef Complex")) return read_nef3(bytes, path);
    if (extension == "nef" || bytes.starts_with("nef ") || is_native_binary(bytes)) return read_native(bytes, path);
  }
  const Mesh mesh = read_mesh(path);
  // What write_polyhedron makes of the empty set.
  if (mesh.vertices.empty() && mesh.face_count() == 0) return Polyhedron();
  try {
    return from_mesh(mesh, options, messages);
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

void write_polyhedron(const std::string& path, const Polyhedron& polyhedron, const PolyhedronWriteOptions& options,
                      Messages* messages) {
  const std::string extension = lower_extension(path);
  if (extension == "nef") {
    write_file(path, options.text ? native_text(polyhedron) : native_binary(polyhedron));
    return;
  }
  if (extension == "nef3") {
    write_file(path, nef3_text(polyhedron, messages));
    return;
  }
  if (!is_mesh_extension(extension)) {
    throw FileError(FileProblem::kUnreadable,
                    path + ": the extension names no format; use nef, nef3, off, obj, stl or ply");
  }
  MeshExportOptions export_options;
  export_options.keep_polygons = options.keep_polygons && extension != "stl";
  const MeshWriteOptions write_options{options.exact, options.binary};
  export_options.polygon_corner = [&](const Rational3& point) {
    return survives_writing(point, extension, write_options);
  };
  MeshExport result = to_mesh(polyhedron, export_options);
  if (messages != nullptr) messages->insert(messages->end(), result.lost.begin(), result.lost.end());
  write_mesh(path, result.mesh, write_options, messages);
}

}  // namespace nef
