// SPDX-License-Identifier: Apache-2.0
//
// nef info | convert | equal
#include <optional>

#include "apps/nef/command/commands.h"
#include "apps/program/set_info.h"
#include "apps/program/tile_flags.h"
#include "nef/base/error.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef {
namespace {

// What is null says nothing to people; what is exact stands beside its double where it is short.
void print_info(Session& session, const Json& info) {
  const auto text = [](const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); };
  for (const auto& [key, value] : info.items()) {
    if (value.is_null() || key == "volume_double" || key == "volume_digits" || key == "volume_error") continue;
    session.say(key + ": " + text(value));
  }
}

// The volume in one line: exact if it was found and is short or wanted, a double and what is known of it otherwise.
std::string volume_text(const Json& info) {
  const Json& approximate = info["volume_double"];
  if (approximate.is_null()) return "infinite";
  if (info.contains("volume_error")) {
    return approximate.dump() + " (off by at most " + info["volume_error"].dump() + ", see --exact)";
  }
  if (info["volume"].is_null()) {
    return approximate.dump() + " (exactly a fraction of " + info["volume_digits"].dump() + " digits, see --exact)";
  }
  const std::string exact = info["volume"].get<std::string>();
  return exact.find('/') == std::string::npos ? exact : exact + " (" + approximate.dump() + ")";
}

// What tiles tell without being glued: the same keys, as far as they go. Each tile is read once, so that little memory
// does if nothing is said of it.
Json tiled_info(Session& session, TileFlags flags) {
  if (flags.memory.empty()) flags.memory = "64M";
  const TiledPolyhedron set = load_tiled(session, session.input, choose_tiles(flags, session, session.input).tiling);
  Json info = {{"tiles", set.tile_count()}, {"vertices_in_tiles", set.vertex_count()}};
  const auto [volume, box] = volume_and_bounding_box(set, session.monitor);
  add_volume(info, volume, {.exact = session.exact});
  add_box(info, box, {.exact = session.exact});
  return info;
}

void require_tiles_for_memory(const TileFlags& flags, bool in_tiles) {
  if (!in_tiles && !flags.memory.empty()) {
    throw InputError("--memory applies to sets in tiles: give a folder NAME.tiles, which nef convert writes");
  }
}

struct InfoFlags {
  bool glued = false;
  TileFlags tiles;
};

void add_info_options(CLI::App& command, Session& session, InfoFlags& flags) {
  command.add_flag("--exact", session.exact,
                   "Print exact numbers, however long they are and however long they take to compute");
  command.add_flag("--glued", flags.glued, "Report everything for a set in tiles, too, which joins its tiles");
  add_memory_flag(&command, flags.tiles);
  command.footer(
      "Centroid, inertia tensor (about the centroid, density 1), principal moments and their axes are those of the\n"
      "solid parts. shells: the surfaces around volumes; a closed surface counts once for each side. euler_numbers:\n"
      "vertices - edges + facets of each shell. genus: of each shell that is a closed manifold surface.");
}

void run_info(Session& session, const InfoFlags& flags) {
  const bool in_tiles = names_tile_folder(session.input) && !flags.glued;
  require_tiles_for_memory(flags.tiles, in_tiles);
  Json info = in_tiles
                  ? tiled_info(session, flags.tiles)
                  : set_info(session.load(session.input), {.exact = session.exact, .moments = true}, session.monitor);
  if (session.json) return session.print("info", {{"result", std::move(info)}});
  info["volume"] = volume_text(info);
  print_info(session, info);
}

void run_convert(Session& session, const TileFlags& flags) {
  if (names_tile_folder(session.output)) {
    const TileChoice tiles = choose_tiles(flags, session, session.input);
    return finish_tiled(session, "convert", load_tiled(session, session.input, tiles.tiling), 0);
  }
  const Polyhedron set = session.load(session.input);
  session.store(set);
  if (!session.json) return session.say(summary(set));
  session.print("convert", {{"result", info_json(set, session.monitor)}});
}

// Folders of tiles are compared tile by tile. Labels, which tiles do not hold, are compared in whole sets.
bool equal_files(Session& session, const std::string& first, const std::string& second, const TileFlags& flags) {
  const bool any_in_tiles = names_tile_folder(first) || names_tile_folder(second);
  require_tiles_for_memory(flags, any_in_tiles);
  if (!any_in_tiles) return equal(session.load(first), session.load(second), session.monitor);
  // One store for both.
  const Tiling tiling = choose_tiles(flags, session, names_tile_folder(first) ? first : second).tiling;
  const auto in_tiles = [&](const std::string& path) -> std::optional<TiledPolyhedron> {
    if (names_tile_folder(path)) return load_tiled(session, path, tiling);
    const Polyhedron set = session.load(path);
    if (set.complex().label_count > 2) return std::nullopt;
    return TiledPolyhedron(set, tiling, session.monitor);
  };
  const std::optional<TiledPolyhedron> a = in_tiles(first);
  const std::optional<TiledPolyhedron> b = in_tiles(second);
  if (a && b) return equal(*a, *b, session.monitor);
  return equal(session.load(first), session.load(second), session.monitor);
}

void run_equal(Session& session, const TileFlags& flags) {
  const bool same = equal_files(session, session.inputs[0], session.inputs[1], flags);
  session.exit_code = same ? kYes : kNo;
  if (session.json) {
    session.print("equal", {{"equal", same}});
  } else {
    session.say(same ? "equal" : "different");
  }
}

}  // namespace

Commands info_commands() {
  return {
      with_flags<InfoFlags>({.name = "info", .description = "Report counts, properties and measures of a set"},
                            add_info_options, run_info),
      with_flags<TileFlags>(
          {.name = "convert", .description = "Read a set and write it in another format", .output = Output::kRequired},
          [](CLI::App& command, Session&, TileFlags& flags) { add_tile_flags(&command, flags); }, run_convert),
      with_flags<TileFlags>(
          {.name = "equal",
           .description = "Compare two sets. Exit code 0 if they are equal, 1 if not",
           .operands = "Files of the two sets",
           .least = 2,
           .most = 2},
          [](CLI::App& command, Session&, TileFlags& flags) { add_memory_flag(&command, flags); }, run_equal)};
}

}  // namespace nef
