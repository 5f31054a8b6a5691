// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh/mesh_reader.h"

#include <algorithm>

#include "nef/base/error.h"
#include "nef/io/mesh/mesh_formats.h"

namespace nef {

Mesh read_mesh(const std::string& path) {
  const PartPath at = part_path(path);
  if (at.part.empty()) return read_mesh(read_file(path), path);
  MeshParts parts;
  const Mesh whole = read_mesh(read_file(at.file), at.file, &parts);
  return faces_of_part(whole, parts, at);
}

Mesh read_mesh(std::string_view bytes, const std::string& path, MeshParts* parts) {
  if (const MeshFormat* format = find_mesh_format(lower_extension(path))) return format->read(bytes, path, parts);
  const auto found = std::find_if(mesh_formats().begin(), mesh_formats().end(),
                                  [&](const MeshFormat& format) { return format.recognizes(bytes); });
  if (found != mesh_formats().end()) return found->read(bytes, path, parts);
  throw FileError(FileProblem::kUnreadable, path + ": the format is unknown; use the extension " +
                                                mesh_format_extensions() + " (of a set: nef or nef3)");
}

}  // namespace nef
