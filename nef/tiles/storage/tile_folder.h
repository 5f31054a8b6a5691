// SPDX-License-Identifier: Apache-2.0
//
// Sets in tiles as folders of files.
//
// A folder NAME.tiles holds each tile as a binary .nef file, whose name is a hash of its bytes, and `index`, a text:
// the tree in preorder, a node a line.
//
//   nef-tiles 1                         the version of the format
//   limit N                             vertices that a tile may have
//   cut x Q                             a cut at x = Q, exactly; below it, then above it, what is on its sides
//   uniform M                           a leaf without boundary, in the set (1) or not (0)
//   tile NAME V a b c A B C             a leaf, its file, its vertices, and the box of its boundary in hexadecimal
//   doubles end HASH                            the XXH3 of all bytes before this line
//
// A word "not" behind cut or tile stands for the complement of what follows.
#pragma once

#include <string>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef {

/// The extension of such folders, without a dot.
inline constexpr const char* kTileFolderExtension = "tiles";
/// The file in such a folder that names all others by their content.
inline constexpr const char* kTileFolderIndex = "index";

/// True if the path has that extension.
bool names_tile_folder(const std::string& path);

/// Writes a set in tiles to a folder, which is made if it is not there; a file that is no such folder is refused. Tiles
/// that are there already are not written again, and the index gets its name last: whoever reads, and a run that is
/// killed, leaves or finds the old set or the whole new one. Then files that the index does not name are removed,
/// unless the set's store uses them. Tiles are loaded one at a time. Throws FileError.
void write_tiles(const std::string& folder, const TiledPolyhedron& set);

/// Reads a set from a folder; operations on it use the limit of the folder and the store. With a store,
/// tiles are read when they are needed; without, all at once. Throws FileError for what is damaged, and so does any
/// operation that needs a damaged tile. That the tiles fit together is taken on trust.
TiledPolyhedron read_tiles(const std::string& folder, std::shared_ptr<TileStore> store = nullptr,
                           const Monitor& monitor = {});

/// A set from a file of any kind (nef/io/polyhedron_file.h) or from a folder of tiles, which it glues.
Polyhedron read_file_or_tiles(const std::string& path, const MeshOptions& options, Messages* messages = nullptr);

}  // namespace nef
