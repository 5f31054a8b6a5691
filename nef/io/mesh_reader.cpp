// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh_reader.h"

namespace nef {
namespace {

Mesh read_by_content(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("ply")) return read_ply(bytes, path);
  if (bytes.starts_with("solid")) return read_stl(bytes, path);
  const std::string_view beginning = bytes.substr(0, 4096);
  const std::size_t header = beginning.find("OFF");
  if (header != std::string_view::npos && header < beginning.find_first_of("\n\r", header))
    return read_off(bytes, path);
  throw FileError(FileProblem::kUnreadable, path + ": the format is unknown; use the extension off, obj, stl or ply");
}

}  // namespace

bool is_mesh_extension(std::string_view extension) {
  return extension == "off" || extension == "obj" || extension == "stl" || extension == "ply";
}

Mesh read_mesh(const std::string& path) {
  const std::string bytes = read_file(path);
  const std::string extension = lower_extension(path);
  if (extension == "off") return read_off(bytes, path);
  if (extension == "obj") return read_obj(bytes, path);
  if (extension == "stl") return read_stl(bytes, path);
  if (extension == "ply") return read_ply(bytes, path);
  return read_by_content(bytes, path);
}

}  // namespace nef
