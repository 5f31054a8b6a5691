// SPDX-License-Identifier: Apache-2.0
//
// The table of mesh formats, a row each: how a file is recognized, its reader and its writer, and what it can hold.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_parts.h"

namespace nef {

struct MeshWriteOptions;

/// How a file holds coordinates.
enum class FileNumbers : std::uint8_t {
  kNone,      ///< the format has no such form
  kFloats,    ///< IEEE single precision
  kDoubles,   ///< IEEE double precision
  kDecimals,  ///< the shortest decimals that give the nearest doubles back
};

/// What a format may hold beside triangles. The names are those of the columns in docs/nef.md.
enum MeshTrait : unsigned {
  kFractions = 1U,      ///< coordinates p/q in place of decimals, in text (--exact)
  kPolygons = 2U,       ///< faces of any number of corners
  kNamedVertices = 4U,  ///< faces refer to vertices, so two vertices may be in the same place
  kWires = 8U,          ///< lines and points that belong to no face
  kFaceGroups = 16U,    ///< faces in groups
  kVertexColors = 32U,  ///< a colour for each vertex
  kNamedParts = 64U,    ///< runs of faces with names, which FILE#NAME reads
  kTexture = 128U,      ///< an image on the faces
};

/// One mesh format. Readers, writers, `--help`, messages and the fuzzer take all they know of formats from here.
struct MeshFormat {
  std::string_view extension;  ///< of its files, in lower case and without the dot
  std::string_view name;       ///< in messages
  FileNumbers text;            ///< coordinates as they are written without --binary
  FileNumbers binary;          ///< the same with --binary; one of both at least is not kNone
  unsigned traits;             ///< of MeshTrait
  /// Whether the bytes begin as a file of this format. At most one format recognizes what one of them has written.
  bool (*recognizes)(std::string_view bytes);
  /// The mesh in the bytes of a file; `path` is for error messages only. `parts`, if not null, receives its named
  /// parts. Throws FileError.
  Mesh (*read)(std::string_view bytes, const std::string& path, MeshParts* parts);
  /// The bytes of a file. Options must be such that the format has.
  std::string (*write)(const Mesh& mesh, const MeshWriteOptions& options);

  [[nodiscard]] bool has(MeshTrait trait) const { return (traits & trait) != 0; }
  /// The coordinates in a file that is written with or without --binary, which formats of one form do not need.
  [[nodiscard]] FileNumbers numbers(bool as_binary) const;
  /// True if --binary chooses between two forms.
  [[nodiscard]] bool has_two_forms() const { return text != FileNumbers::kNone && binary != FileNumbers::kNone; }
};

/// All rows, in the order in which the documentation and messages list them.
std::span<const MeshFormat> mesh_formats();

/// The row of an extension (lower case, without the dot), or null.
const MeshFormat* find_mesh_format(std::string_view extension);
/// The row of the format that a file is to be written in: `format` if it is not empty, else the extension of the path.
/// Throws FileError that lists the extensions if it is none of a mesh.
const MeshFormat& mesh_format_of(const std::string& path, const std::string& format = {});

/// The names of the formats that `suits` selects, for messages: "OFF, OBJ or PLY".
std::string mesh_format_names(const std::function<bool(const MeshFormat&)>& suits,
                              const std::string& conjunction = "or");
/// The names of the formats with a trait.
std::string mesh_format_names(MeshTrait trait, const std::string& conjunction = "or");
/// All extensions: "off, obj, stl, ply, glb or 3mf".
std::string mesh_format_extensions();

}  // namespace nef
