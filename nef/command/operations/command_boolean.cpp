// SPDX-License-Identifier: Apache-2.0
//
// The commands `nef union`, `intersection`, `difference` and `symdiff`. They are rows of one table: a name, the
// function that computes the result, the test that tells from the operands of a point whether it belongs to the result
// (for --origins), and the operator that takes one operand after another (for tiles). A run takes one of four ways:
// with origins, in tiles one operand after another, in tiles region by region (unions of very many sets), or in memory.
#include <algorithm>
#include <filesystem>
#include <set>

#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/command/commands.h"
#include "nef/operation/label_inputs.h"
#include "nef/program/tile_flags.h"
#include "nef/tiles/import/union_in_tiles.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef {
namespace {

struct Operation {
  std::string name;
  std::string description;
  int most;  // operands
  Polyhedron (*compute)(std::span<const Polyhedron>, unsigned threads, const Monitor& monitor);
  bool (*holds)(const InputSet& inputs, std::size_t count);  // whether a point in these inputs is in the result
  BooleanOperator step;                                      // that takes one operand after the other
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

// The boundary of the result, face by face with the inputs that it comes from.
void finish_with_origins(Session& session, const Operation& operation, const std::vector<Polyhedron>& sets) {
  if (session.output.empty()) throw InputError("--origins writes a mesh: give it a name with -o");
  const Stopwatch watch;
  const LabeledPolyhedron<InputSet> labeled = label_inputs(sets, session.threads, session.monitor);
  const double seconds = watch.seconds();
  const auto holds = [&](const InputSet& inputs) { return operation.holds(inputs, sets.size()); };
  const std::vector<std::string> names = short_names(session.inputs);
  BoundaryGroups groups;
  groups.selected = [&](LabelId mark) { return mark < labeled.labels().size() && holds(labeled.label(mark)); };
  groups.name = [&](LabelId inside, LabelId outside, LabelId) {
    std::string text;
    for (const std::uint32_t input : origins(labeled.label(inside), labeled.label(outside))) {
      text += (text.empty() ? "" : "+") + names[input];
    }
    return text;
  };
  const std::map<std::string, std::size_t> faces = session.store_groups(labeled.polyhedron(), groups);
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
  const RegionalUnion regions = divide_pieces(first_time, session.threads, kSetsOfARegion, session.monitor);
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

void add(CLI::App& app, Session& session, const Operation& operation) {
  CLI::App* command = add_subcommand(app, session, operation.name, operation.description);
  command->add_option("inputs", session.inputs, "The operands, as files")->required()->expected(2, operation.most);
  add_input_flags(command, session);
  add_output_flags(command, session);
  CLI::Option* repeat = command->add_option("--repeat", session.repeat, "Compute N times and report the median")
                            ->check(CLI::Range(1, 1000000));
  command
      ->add_flag("--origins", session.origins,
                 "Write from which operand each face comes: groups in OBJ, colours in OFF, PLY and GLB")
      ->excludes(repeat);
  const auto flags = std::make_shared<TileFlags>();
  add_tile_flags(command, *flags);
  command->callback([&session, operation, flags] {
    const TileChoice tiles = choose_tiles(*flags, session, session.inputs[0]);
    if (wants_regions(session, operation, tiles) && run_by_regions(session, operation, tiles)) return;
    if (!session.origins && tiles.use == TileUse::kAlways) return run_in_tiles(session, operation, tiles);
    const std::vector<Polyhedron> sets = session.load_all(session.inputs);
    if (session.origins) return finish_with_origins(session, operation, sets);
    finish(session, operation.name, measure(session.repeat, session.monitor, [&](const Monitor& monitor) {
             return operation.compute(sets, session.threads, monitor);
           }));
  });
}

}  // namespace

void add_boolean_commands(CLI::App& app, Session& session) {
  constexpr int kMany = CLI::detail::expected_max_vector_size;
  using Sets = std::span<const Polyhedron>;
  add(app, session,
      {"union", "The points of any of the sets", kMany,
       [](Sets s, unsigned n, const Monitor& m) {
         return s.size() == 2 ? unite(s[0], s[1], n, m) : unite_all(s, n, m);
       },
       [](const InputSet& inputs, std::size_t) { return !inputs.empty(); }, BooleanOperator::kUnion});
  add(app, session,
      {"intersection", "The points of all of the sets", kMany,
       [](Sets s, unsigned n, const Monitor& m) {
         return s.size() == 2 ? intersect(s[0], s[1], n, m) : intersect_all(s, n, m);
       },
       [](const InputSet& inputs, std::size_t count) { return inputs.size() == count; },
       BooleanOperator::kIntersection});
  add(app, session,
      {"difference", "The points of the first set that are in none of the others", kMany,
       [](Sets s, unsigned n, const Monitor& m) { return subtract(s[0], unite_all(s.subspan(1), n, m), n, m); },
       [](const InputSet& inputs, std::size_t) { return inputs == InputSet{0}; }, BooleanOperator::kDifference});
  add(app, session,
      {"symdiff", "The points of exactly one of two sets", 2,
       [](Sets s, unsigned n, const Monitor& m) { return symmetric_difference(s[0], s[1], n, m); },
       [](const InputSet& inputs, std::size_t) { return inputs.size() == 1; }, BooleanOperator::kSymmetricDifference});
}

}  // namespace nef
