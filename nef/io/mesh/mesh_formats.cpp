// SPDX-License-Identifier: Apache-2.0
#include "nef/io/mesh/mesh_formats.h"

#include <algorithm>
#include <array>
#include <vector>

#include "nef/base/error.h"
#include "nef/base/text/word_list.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/formats/glb_mesh.h"
#include "nef/io/mesh/formats/threemf_mesh.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"

namespace nef {
namespace {

bool is_ply(std::string_view bytes) { return bytes.starts_with("ply"); }
bool is_glb(std::string_view bytes) { return bytes.starts_with("glTF"); }
bool is_3mf(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

// The reader of a format whose files have no named parts.
template <Mesh (*kRead)(std::string_view, const std::string&)>
Mesh read_whole(std::string_view bytes, const std::string& path, MeshParts* /*parts*/) {
  return kRead(bytes, path);
}

constexpr std::array kFormats{
    MeshFormat{"off", "OFF", FileNumbers::kDecimals, FileNumbers::kNone,
               kFractions | kPolygons | kNamedVertices | kFaceGroups, is_off, read_whole<read_off>, off_bytes},
    MeshFormat{"obj", "OBJ", FileNumbers::kDecimals, FileNumbers::kNone,
               kFractions | kPolygons | kNamedVertices | kWires | kFaceGroups | kNamedParts | kTexture, is_obj,
               read_obj, obj_bytes},
    MeshFormat{"stl", "STL", FileNumbers::kDecimals, FileNumbers::kFloats, 0, is_stl, read_whole<read_stl>, stl_bytes},
    MeshFormat{"ply", "PLY", FileNumbers::kDecimals, FileNumbers::kDoubles,
               kFractions | kPolygons | kNamedVertices | kFaceGroups | kVertexColors | kTexture, is_ply,
               read_whole<read_ply>, ply_bytes},
    MeshFormat{"glb", "GLB", FileNumbers::kNone, FileNumbers::kFloats,
               kNamedVertices | kFaceGroups | kVertexColors | kNamedParts | kTexture, is_glb, read_glb, glb_bytes},
    MeshFormat{"3mf", "3MF", FileNumbers::kDecimals, FileNumbers::kNone,
               kNamedVertices | kVertexColors | kNamedParts | kTexture, is_3mf, read_3mf, threemf_bytes},
};

}  // namespace

FileNumbers MeshFormat::numbers(bool as_binary) const {
  if (as_binary) return binary != FileNumbers::kNone ? binary : text;
  return text != FileNumbers::kNone ? text : binary;
}

std::span<const MeshFormat> mesh_formats() { return kFormats; }

const MeshFormat* find_mesh_format(std::string_view extension) {
  const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                  [&](const MeshFormat& format) { return format.extension == extension; });
  return found == kFormats.end() ? nullptr : &*found;
}

const MeshFormat& mesh_format_of(const std::string& path, const std::string& format) {
  const MeshFormat* found = find_mesh_format(format.empty() ? lower_extension(path) : format);
  if (found != nullptr) return *found;
  throw FileError(FileProblem::kUnreadable,
                  path + ": not the extension of a mesh format; use " + mesh_format_extensions());
}

std::string mesh_format_names(const std::function<bool(const MeshFormat&)>& suits, const std::string& conjunction) {
  std::vector<std::string_view> names;
  for (const MeshFormat& format : kFormats) {
    if (suits(format)) names.push_back(format.name);
  }
  return word_list(names, conjunction);
}

std::string mesh_format_names(MeshTrait trait, const std::string& conjunction) {
  return mesh_format_names([trait](const MeshFormat& format) { return format.has(trait); }, conjunction);
}

std::string mesh_format_extensions() {
  std::vector<std::string_view> names;
  for (const MeshFormat& format : kFormats) names.push_back(format.extension);
  return word_list(names, "or");
}

}  // namespace nef
