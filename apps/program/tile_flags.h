// SPDX-License-Identifier: Apache-2.0
//
// Options of subcommands that can work in tiles.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/program/reports/report.h"
#include "apps/program/session.h"
#include "nef/tiles/step_sequence.h"

namespace nef {

/// --tiles and --memory, as they were given.
struct TileFlags {
  std::string tiles = "auto";
  std::string memory;
};

void add_tile_flags(CLI::App* command, TileFlags& flags);
/// --memory alone, of a subcommand that only reads sets in tiles.
void add_memory_flag(CLI::App* command, TileFlags& flags);

/// Whether a run works in tiles, and how.
struct TileChoice {
  TileUse use = TileUse::kWherePays;
  Tiling tiling;
};

/// What the flags ask for. The files of a run stand beside its output, if that is a file. A bound on memory, and a
/// first operand that is in tiles already, mean tiles from the beginning. Throws InputError.
TileChoice choose_tiles(const TileFlags& flags, const Session& session, const std::string& first_input);

/// Reads a set into tiles: what is in tiles stays so.
TiledPolyhedron load_tiled(Session& session, const std::string& path, const Tiling& tiling);

/// Writes the result, in tiles if its name asks for that, else glued, and prints what the flags ask for. `seconds`: the
/// time of the operation. `more`: members of the report.
void finish_tiled(Session& session, const std::string& command, const TiledPolyhedron& set, double seconds,
                  const Json& more = Json::object());

}  // namespace nef
