// SPDX-License-Identifier: Apache-2.0
//
// The commands `nef union`, `intersection`, `difference` and `symdiff`. They are rows of one table: a name, the
// function that computes the result, and the operator that takes one operand after another (for tiles). A run takes one
// of four ways: with origins, in tiles one operand after another, in tiles region by region (unions of very many sets),
// or in memory.
#include <algorithm>
#include <filesystem>
#include <set>

#include "apps/nef/command/commands.h"
#include "apps/program/tile_flags.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/export/mesh_with_origins.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_formats.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/tiles/import/union_in_tiles.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef {
namespace {

struct Operation {
  const char* name;
  const char* description;
  int least;  // operands; one file may have several parts
  int most;
  Polyhedron (*compute)(std::span<const Polyhedron>, const Monitor& monitor);
  BooleanOperator step;  // that takes one operand after the other
};

// What the groups of faces are called: the names of files, with their folders only where these tell them apart.
std::vector<std::string> short_names(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(std::filesystem::path(path).filename().string());
  if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) return names;
  names = paths;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::count(paths.begin(), paths.end(), paths[i]) > 1) names[i] += ":" + std::to_string(i + 1);
  }
  return names;
}

struct Operands {
  std::vector<Polyhedron> sets;
  std::vector<std::string> names;
};

// The operands of a union, of files with several parts each part by itself.
Operands load_parts(Session& session) {
  const std::vector<std::string> names = short_names(session.inputs);
  Operands result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& path = session.inputs[i];
    std::vector<NamedMesh> parts;
    if (find_mesh_format(lower_extension(path)) != nullptr) {
      MeshParts named;
      const Mesh whole = read_mesh(read_file(path), path, &named);
      parts = split_into_parts(whole, named);
    }
    if (parts.size() < 2) {
      result.sets.push_back(session.load(path));
      result.names.push_back(names[i]);
      continue;
    }
    for (const NamedMesh& part : parts) {
      const std::string suffix = part.name.empty() ? "" : "#" + part.name;
      result.sets.push_back(session.solid_of(part.mesh, path + suffix));
      result.names.push_back(names[i] + suffix);
    }
  }
  return result;
}

// The boundary of the result, face by face with the inputs that it comes from.
void finish_with_origins(Session& session, const Operation& operation) {
  if (session.output.empty()) throw InputError("--origins writes a mesh: name its file with -o");
  const Operands operands = operation.step == BooleanOperator::kUnion
                                ? load_parts(session)
                                : Operands{session.load_all(session.inputs), short_names(session.inputs)};
  const std::vector<Polyhedron>& sets = operands.sets;
  const std::vector<std::string>& names = operands.names;
  const Stopwatch watch;
  const LabeledPolyhedron<InputSet> labeled = label_inputs(sets, session.monitor);
  const double seconds = watch.seconds();
  const Membership belongs = membership(operation.name);
  const auto holds = [&](const InputSet& inputs) { return belongs(inputs, sets.size()); };
  BoundaryGroups groups;
  groups.selected = [&](LabelId mark) { return mark < labeled.labels().size() && holds(labeled.label(mark)); };
  std::vector<bool> is_seen(names.size(), false);
  groups.name = [&](LabelId inside, LabelId outside, LabelId) {
    std::string text;
    for (const std::uint32_t input : origins(labeled.label(inside), labeled.label(outside))) {
      text += (text.empty() ? "" : "+") + names[input];
      is_seen[input] = true;
    }
    return text;
  };
  std::map<std::string, std::size_t> faces = session.store_groups(labeled.polyhedron(), groups);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_seen[i]) faces.emplace(names[i], 0);
  }
  const Polyhedron result = labeled.where(holds, session.monitor);
  if (session.json) {
    session.spent("op", seconds);
    return session.print(operation.name, {{"origins", faces}, {"result", info_json(result, session.monitor)}});
  }
  session.say(summary(result));
  for (const auto& [name, count] : faces) {
    session.say(name + ": " + std::to_string(count) + (count == 1 ? " face" : " faces"));
  }
}

// One operand after the other, so that no two of them are in memory; of those in tiles, what the set's tiles meet.
void run_in_tiles(Session& session, const Operation& operation, const TileChoice& tiles) {
  TiledPolyhedron first = load_tiled(session, session.inputs[0], tiles.tiling);
  StepSequence sequence(std::move(first), session.inputs.size() - 1);
  double seconds = 0;
  for (std::size_t i = 1; i < session.inputs.size(); ++i) {
    const auto apply = [&](const auto& operand) {
      const Stopwatch watch;
      session.show_phase("operands", i - 1, session.inputs.size() - 1);
      sequence.apply(operation.step, operand, session.monitor);
      seconds += watch.seconds();
    };
    if (tiles.tiling.store != nullptr && names_tile_folder(session.inputs[i])) {
      apply(load_tiled(session, session.inputs[i], tiles.tiling));
    } else {
      apply(session.load(session.inputs[i]));
    }
  }
  finish_tiled(session, operation.name, sequence.tiled(tiles.tiling, session.monitor), seconds);
}

// The operands that a run unites.
std::vector<std::string> to_unite(const Session& session, const Operation& operation) {
  if (operation.step == BooleanOperator::kUnion) return session.inputs;
  if (operation.step != BooleanOperator::kDifference) return {};
  return {session.inputs.begin() + 1, session.inputs.end()};
}

// Where the result stays in tiles, very many sets are united region by region rather than one after the other.
bool wants_regions(const Session& session, const Operation& operation, const TileChoice& tiles) {
  if (session.origins || session.repeat > 1 || tiles.use == TileUse::kNever) return false;
  if (tiles.use != TileUse::kAlways && !names_tile_folder(session.output)) return false;
  const std::vector<std::string> paths = to_unite(session, operation);
  return paths.size() >= kSetsForRegions && std::none_of(paths.begin(), paths.end(), names_tile_folder);
}

// Sets are read when a region needs them if memory is bounded, else once. False if they are not spread enough for
// regions; nothing is printed then.
bool run_by_regions(Session& session, const Operation& operation, const TileChoice& tiles) {
  const std::vector<std::string> paths = to_unite(session, operation);
  const bool held = tiles.tiling.store == nullptr;
  std::vector<Polyhedron> sets(held ? paths.size() : 0);
  std::vector<Messages> notes(paths.size());
  const auto read = [&](std::uint32_t i, Messages* messages, const Monitor& own) {
    MeshOptions options = session.mesh;
    options.monitor = own;
    return read_file_or_tiles(paths[i], options, messages);
  };
  const PieceSource first_time{.count = static_cast<std::uint32_t>(paths.size()),
                               .set = [&](std::uint32_t i, const Monitor& own) {
                                 Polyhedron set = read(i, &notes[i], own);
                                 if (held) sets[i] = set;
                                 return set;
                               }};
  const PieceSource pieces{.count = first_time.count, .set = [&](std::uint32_t i, const Monitor& own) {
                             return held ? sets[i] : read(i, nullptr, own);
                           }};
  session.show_phase("reading");
  const Stopwatch reading;
  const RegionalUnion regions = divide_pieces(first_time, kSetsOfARegion, session.monitor);
  if (!regions.is_spread()) return false;
  for (const Messages& some : notes) session.note_all(some);
  session.spent("read_operands", reading.seconds());
  const Stopwatch watch;
  TiledPolyhedron result = union_in_tiles(pieces, regions, tiles.tiling, session.monitor);
  if (operation.step == BooleanOperator::kDifference) {
    result = subtract(load_tiled(session, session.inputs[0], tiles.tiling), result, session.monitor);
  }
  finish_tiled(session, operation.name, result, watch.seconds());
  return true;
}

void add_boolean_options(CLI::App& command, Session& session, TileFlags& flags) {
  command
      .add_flag("--origins", session.origins,
                "Mark each face with the operand that it comes from: groups in OBJ, colours in OFF, PLY and GLB. In a "
                "union, each part of an OBJ, GLB or 3MF file counts as an operand")
      ->excludes(command.get_option("--repeat"));
  add_tile_flags(&command, flags);
}

void run_boolean(Session& session, const TileFlags& flags, const Operation& operation) {
  const TileChoice tiles = choose_tiles(flags, session, session.inputs[0]);
  if (wants_regions(session, operation, tiles) && run_by_regions(session, operation, tiles)) return;
  if (!session.origins && tiles.use == TileUse::kAlways) return run_in_tiles(session, operation, tiles);
  if (session.origins) return finish_with_origins(session, operation);
  const std::vector<Polyhedron> sets = session.load_all(session.inputs);
  finish(session, operation.name, measure(session.repeat, session.monitor, [&](const Monitor& monitor) {
           return operation.compute(sets, monitor);
         }));
}

using Sets = std::span<const Polyhedron>;

const std::array<Operation, 4> kOperations{
    {{"union", "The union: points of at least one of the sets", 1, kAnyNumber,
      [](Sets s, const Monitor& m) { return s.size() == 2 ? unite(s[0], s[1], m) : unite_all(s, m); },
      BooleanOperator::kUnion},
     {"intersection", "The intersection: points of all of the sets", 2, kAnyNumber,
      [](Sets s, const Monitor& m) { return s.size() == 2 ? intersect(s[0], s[1], m) : intersect_all(s, m); },
      BooleanOperator::kIntersection},
     {"difference", "The difference: points of the first set that are in none of the others", 2, kAnyNumber,
      [](Sets s, const Monitor& m) { return subtract(s[0], unite_all(s.subspan(1), m), m); },
      BooleanOperator::kDifference},
     {"symdiff", "The symmetric difference: points of exactly one of two sets", 2, 2,
      [](Sets s, const Monitor& m) { return symmetric_difference(s[0], s[1], m); },
      BooleanOperator::kSymmetricDifference}}};

}  // namespace

Commands boolean_commands() {
  Commands rows;
  for (const Operation& operation : kOperations) {
    rows.push_back(with_flags<TileFlags>({.name = operation.name,
                                          .description = operation.description,
                                          .operands = "Files of the operands",
                                          .least = operation.least,
                                          .most = operation.most,
                                          .output = Output::kOptional,
                                          .repeats = true},
                                         add_boolean_options, [&operation](Session& session, const TileFlags& flags) {
                                           run_boolean(session, flags, operation);
                                         }));
  }
  return rows;
}

}  // namespace nef
