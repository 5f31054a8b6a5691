// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh/mesh_reader.h"

#include "nef/io/mesh/glb_mesh.h"
#include "nef/io/mesh/threemf_mesh.h"
#include "nef/io/text_cursor.h"

namespace nef {
namespace {

// A line of OBJ comes first, but for comments. Words of other files that an OBJ might begin with tell nothing.
bool begins_like_obj(std::string_view bytes, const std::string& path) {
  TextCursor cursor(bytes, path);
  const std::string_view word = cursor.word();
  return word == "v" || word == "o" || word == "g" || word == "mtllib" || word == "usemtl" || word == "vt" ||
         word == "vn";
}

Mesh read_by_content(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("ply")) return read_ply(bytes, path);
  if (bytes.starts_with("glTF")) return read_glb(bytes, path);
  if (bytes.starts_with("PK\x03\x04")) return read_3mf(bytes, path);
  if (bytes.starts_with("solid") || is_binary_stl(bytes)) return read_stl(bytes, path);
  const std::string_view beginning = bytes.substr(0, 4096);
  const std::size_t header = beginning.find("OFF");
  if (header != std::string_view::npos && header < beginning.find_first_of("\n\r", header))
    return read_off(bytes, path);
  if (begins_like_obj(bytes, path)) return read_obj(bytes, path);
  throw FileError(FileProblem::kUnreadable,
                  path + ": the format is unknown; use the extension off, obj, stl, ply, glb or 3mf");
}

}  // namespace

bool is_mesh_extension(std::string_view extension) {
  return extension == "off" || extension == "obj" || extension == "stl" || extension == "ply" || extension == "glb" ||
         extension == "3mf";
}

Mesh read_mesh(const std::string& path) { return read_mesh(read_file(path), path); }

Mesh read_mesh(std::string_view bytes, const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension == "off") return read_off(bytes, path);
  if (extension == "obj") return read_obj(bytes, path);
  if (extension == "stl") return read_stl(bytes, path);
  if (extension == "ply") return read_ply(bytes, path);
  if (extension == "glb") return read_glb(bytes, path);
  if (extension == "3mf") return read_3mf(bytes, path);
  return read_by_content(bytes, path);
}

}  // namespace nef
