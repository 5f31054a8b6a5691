// SPDX-License-Identifier: Apache-2.0
//
// The rules by which --tiles, --memory and the names of input and output choose between one complex and tiles: a .tiles
// folder or a bound on memory asks for tiles from the beginning, a number sets their size, and `auto` leaves the choice
// to the operation.
#include "apps/program/tile_flags.h"

#include <charconv>
#include <filesystem>
#include <limits>

#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/base/text/in_quotes.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/tiles/import/mesh_tiles.h"
#include "nef/tiles/storage/tile_folder.h"
#include "nef/tiles/storage/tile_store.h"
#include "nef/tiles/tile_tree.h"

namespace nef {
namespace {

std::size_t tile_limit(const std::string& word) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  constexpr std::size_t kFewest = 32;  // a box with a corner cut off in each corner
  if (error != std::errc() || end != word.data() + word.size() || value < kFewest) {
    throw InputError("--tiles takes auto, off or the maximal number of vertices of a tile, at least " +
                     std::to_string(kFewest) + "; not '" + word + "'");
  }
  return value;
}

// "2G", "1.5G", "800M", "64K" or a number of bytes; powers of 1024.
std::uint64_t bytes_of(const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const std::string unit(end, word.data() + word.size());
  constexpr std::string_view kUnits = "KMGT";
  const std::size_t power = unit.empty() ? 0 : kUnits.find(unit[0]) + 1;  // npos + 1 is 0
  const bool known = unit.empty() || (power > 0 && (unit.size() == 1 || unit.substr(1) == "B"));
  if (error != std::errc() || !known || !(value > 0) || value > 1e15) {
    throw InputError("--memory takes a size such as 800M or 2G, not " + in_quotes(word));
  }
  for (std::size_t i = 0; i < power; ++i) value *= 1024;
  return static_cast<std::uint64_t>(value);
}

std::filesystem::path folder_for_files(const Session& session) {
  if (session.output.empty() || session.output == "-") return std::filesystem::temp_directory_path();
  std::filesystem::path output = session.output;
  if (!output.has_filename()) output = output.parent_path();  // NAME.tiles/
  return output.parent_path();
}

TiledPolyhedron mesh_in_tiles(Session& session, const std::string& path, const Tiling& tiling) {
  const Mesh mesh = read_mesh(path);
  if (mesh.vertices.empty() && mesh.face_count() == 0) return {TiledPolyhedron().tree(), tiling};
  Messages notes;
  MeshOptions options = session.mesh;
  options.monitor = session.monitor;
  try {
    TiledPolyhedron set = tiles_from_mesh(mesh, options, tiling, &notes);
    session.note_all(notes);
    return set;
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

}  // namespace

void add_tile_flags(CLI::App* command, TileFlags& flags) {
  command
      ->add_option("--tiles", flags.tiles,
                   "Maximal number of vertices of a tile; off: no tiles; auto: tiles when they save time, and with "
                   "--memory or a .tiles file")
      ->type_name("N|off|auto")
      ->capture_default_str();
  command
      ->add_option("--memory", flags.memory,
                   "Memory for tiles, such as 800M or 2G; the others are kept in files beside the output")
      ->type_name("SIZE");
}

void add_memory_flag(CLI::App* command, TileFlags& flags) {
  command
      ->add_option(
          "--memory", flags.memory,
          "Memory for the tiles of a folder NAME.tiles, such as 800M or 2G; tiles beyond it are read again when needed")
      ->type_name("SIZE");
}

TileChoice choose_tiles(const TileFlags& flags, const Session& session, const std::string& first_input) {
  TileChoice result;
  if (flags.tiles == "off") {
    if (!flags.memory.empty()) throw InputError("--memory needs tiles: remove --tiles off");
    result.use = TileUse::kNever;
    return result;
  }
  if (flags.tiles != "auto") {
    result.tiling.limit = tile_limit(flags.tiles);
    result.use = TileUse::kAlways;
  }
  const bool in_tiles = names_tile_folder(first_input);
  const bool in_files = !flags.memory.empty() || in_tiles || names_tile_folder(session.output);
  if (flags.tiles == "auto" && in_files) result.tiling.limit = kVerticesOfTileInFile;
  if (!flags.memory.empty() || in_tiles) {
    // Without a bound, tiles are read when they are needed, and stay.
    const std::uint64_t memory =
        flags.memory.empty() ? std::numeric_limits<std::uint64_t>::max() : bytes_of(flags.memory);
    result.tiling.store = std::make_shared<TileStore>(folder_for_files(session), memory);
    result.use = TileUse::kAlways;
  }
  return result;
}

TiledPolyhedron load_tiled(Session& session, const std::string& path, const Tiling& tiling) {
  const bool in_tiles = names_tile_folder(path);
  if (!in_tiles && find_mesh_format(lower_extension(path)) == nullptr) {
    return TiledPolyhedron(session.load(path), tiling, session.monitor);
  }
  const Stopwatch watch;
  session.show_phase("reading");
  TiledPolyhedron set =
      in_tiles ? read_tiles(path, tiling.store, session.monitor) : mesh_in_tiles(session, path, tiling);
  session.spent("read_tiles", watch.seconds());
  return set;
}

void finish_tiled(Session& session, const std::string& command, const TiledPolyhedron& set, double seconds,
                  const Json& more) {
  if (!names_tile_folder(session.output)) {
    session.show_phase("gluing");
    Measured glued;
    const Stopwatch watch;
    glued.set = set.polyhedron(session.monitor);
    session.spent("glue", watch.seconds());
    glued.seconds = seconds;
    return finish(session, command, glued, more);
  }
  require_no_mesh_flags(session.output, session.mesh_file);
  session.show_phase("writing " + session.output);
  const Stopwatch watch;
  write_tiles(session.output, set);
  const double write_seconds = watch.seconds();
  session.say(counted(set.tile_count(), "tile, ", "tiles, ") +
              counted(set.vertex_count(), "vertex in them", "vertices in them"));
  if (!session.json && session.report.empty()) return;
  Json found = more;
  found["result"] = {{"tiles", set.tile_count()}, {"vertices_in_tiles", set.vertex_count()}};
  if (set.tiling().store) {
    const TileStore::Counts counts = set.tiling().store->counts();
    found["result"]["tiles_read"] = counts.read;
    found["result"]["tiles_put_in_files"] = counts.written;
  }
  session.spent("op", seconds);
  session.spent("write_tiles", write_seconds);
  session.print(command, found);
}

}  // namespace nef
