// SPDX-License-Identifier: Apache-2.0
//
// Polygon meshes from files of any format of the table in mesh_formats.h.
#pragma once

#include <string>
#include <string_view>

#include "nef/construct/construct.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_parts.h"

namespace nef {

/// The mesh in a file; the format is chosen by the extension (see mesh_formats.h; any case), or by the
/// beginning of the file where the extension says nothing. Coordinates are the rationals that the text
/// spells (0.1 is one tenth, 1/3 is allowed) or that the binary floats are. Faces stay polygons; colours,
/// normals, texture coordinates and comments are skipped. The vertices of an STL are merged where they are
/// exactly equal. Every index of the result names a vertex and every face has at least three corners; nothing else is
/// checked (see nef/mesh/mesh_check.h).
///
/// Throws FileError with "path:line: what" (a byte offset in binary files) for a file that is missing, a
/// directory, empty or cut off, that breaks its format or its own counts, or that holds a coordinate which is no
/// finite number or an index out of range. O(size of the file) expected; 100000 triangles take about 50 ms.
/// "FILE#NAME" is the part of that name (part_path); InputError if there is none.
Mesh read_mesh(const std::string& path);
/// The same for the bytes of a file that has been read; `path` tells the extension. `parts`, if not null, receives the
/// named parts of a format that has them.
Mesh read_mesh(std::string_view bytes, const std::string& path, MeshParts* parts = nullptr);

// The single formats, on the bytes of a file; `path` is for error messages only.
Mesh read_off(std::string_view bytes, const std::string& path);
Mesh read_obj(std::string_view bytes, const std::string& path, MeshParts* parts = nullptr);
Mesh read_stl(std::string_view bytes, const std::string& path);
Mesh read_ply(std::string_view bytes, const std::string& path);

// Whether bytes begin as a file of the format: the first word of OFF, a first line of OBJ, the word or the length of
// STL.
bool is_off(std::string_view bytes);
bool is_obj(std::string_view bytes);
bool is_stl(std::string_view bytes);

/// True if the length of the bytes is the one that the header of a binary STL would promise.
bool is_binary_stl(std::string_view bytes);

}  // namespace nef
