// SPDX-License-Identifier: Apache-2.0
//
// Polygon meshes from files: OFF, OBJ, STL and PLY, text and binary, GLB and 3MF.
#pragma once

#include <string>
#include <string_view>

#include "nef/construct/construct.h"
#include "nef/io/file_bytes.h"

namespace nef {

/// The mesh in a file; the format is chosen by the extension (off, obj, stl, ply, glb, 3mf; any case), or by the
/// beginning of the file where the extension says nothing. Coordinates are the rationals that the text
/// spells (0.1 is one tenth, 1/3 is allowed) or that the binary floats are. Faces stay polygons; colours,
/// normals, texture coordinates and comments are skipped. The vertices of an STL are merged where they are
/// exactly equal. Every index of the result names a vertex and every face has at least three corners; nothing else is
/// checked (see nef/mesh/mesh_check.h).
///
/// Throws FileError with "path:line: what" (a byte offset in binary files) for a file that is missing, a
/// directory, empty or cut off, that breaks its format or its own counts, or that holds a coordinate which is no
/// finite number or an index out of range. O(size of the file) expected; 100000 triangles take about 50 ms.
Mesh read_mesh(const std::string& path);
/// The same for the bytes of a file that has been read; `path` tells the extension.
Mesh read_mesh(std::string_view bytes, const std::string& path);

// The single formats, on the bytes of a file; `path` is for error messages only.
Mesh read_off(std::string_view bytes, const std::string& path);
Mesh read_obj(std::string_view bytes, const std::string& path);
Mesh read_stl(std::string_view bytes, const std::string& path);
Mesh read_ply(std::string_view bytes, const std::string& path);

/// True if the length of the bytes is the one that the header of a binary STL would promise.
bool is_binary_stl(std::string_view bytes);

/// True if read_mesh knows the extension (lower case, without the dot).
bool is_mesh_extension(std::string_view extension);

}  // namespace nef
