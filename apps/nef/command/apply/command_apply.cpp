// SPDX-License-Identifier: Apache-2.0
//
// nef apply
#include <filesystem>

#include "apps/nef/command/apply/steps_file.h"
#include "apps/nef/command/commands.h"
#include "apps/program/tile_flags.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/io/file_bytes.h"
#include "nef/tiles/storage/tile_folder.h"

namespace nef {
namespace {

struct ApplyFlags {
  std::string steps;
  TileFlags tiles;
};

StepSequence begin(const TileChoice& tiles, std::size_t steps, Session& session) {
  if (tiles.use != TileUse::kAlways) {
    return {session.load(session.input), steps, tiles.use, tiles.tiling, session.monitor};
  }
  return StepSequence(load_tiled(session, session.input, tiles.tiling), steps);
}

// The seconds of each step, and of all.
double apply_steps(StepSequence& sequence, const std::vector<BooleanStep>& steps, const std::string& path,
                   Session& session, const ExpressionOptions& options, Json& report) {
  report = Json::array();
  double all = 0;
  for (const BooleanStep& step : steps) {
    session.show_phase("steps", report.size(), steps.size());
    const Polyhedron operand = operand_of(step, path, options);
    const Stopwatch watch;
    sequence.apply(step.op, operand, options.monitor);
    Json entry;
    entry["line"] = step.line;
    entry["operator"] = std::string(1, step.symbol);
    const double seconds = watch.seconds();
    entry["op_s"] = seconds;
    all += seconds;
    entry["tiles"] = sequence.tile_count() == 0 ? Json() : Json(sequence.tile_count());
    report.push_back(std::move(entry));
  }
  return all;
}

void add_apply_options(CLI::App& command, Session&, ApplyFlags& flags) {
  command
      .add_option("--steps", flags.steps, "File of steps, one operator and expression per line; - reads standard input")
      ->required()
      ->type_name("FILE");
  add_tile_flags(&command, flags.tiles);
  command.footer(
      "A step is one line: + A (union), - A (difference), * A (intersection) or ^ A (symmetric difference), where A "
      "is\n"
      "an expression as in nef eval; its file names are relative to the file of steps. '#' begins a comment.\n"
      "  - box(0,0,0, 1,1,1)\n"
      "  + translate(file(\"boss.off\"), 3,0,0)   # a comment\n"
      "The output is in canonical order: its bytes do not depend on --tiles and --threads. --json reports the seconds "
      "of\n"
      "each step and the number of tiles after it.");
}

void run_apply(Session& session, const ApplyFlags& flags, const CommandExtensions& extensions) {
  const TileChoice tiles = choose_tiles(flags.tiles, session, session.input);
  const std::vector<BooleanStep> steps = parse_steps(read_file(flags.steps), flags.steps);
  ExpressionOptions options = expression_options(session, extensions, std::filesystem::path(flags.steps).parent_path());
  Json report;
  StepSequence sequence = begin(tiles, steps.size(), session);
  const bool to_tiles = names_tile_folder(session.output);
  if (to_tiles || tiles.tiling.store) {
    const double seconds = apply_steps(sequence, steps, flags.steps, session, options, report);
    const TiledPolyhedron set = sequence.tiled(tiles.tiling, session.monitor);
    return finish_tiled(session, "apply", set, seconds, {{"steps", std::move(report)}});
  }
  const Measured measured = measure(1, session.monitor, [&](const Monitor& monitor) {
    options.monitor = monitor;
    apply_steps(sequence, steps, flags.steps, session, options, report);
    session.show_phase("gluing");
    return sequence.result(monitor);
  });
  finish(session, "apply", measured, {{"steps", std::move(report)}});
}

}  // namespace

Commands apply_commands(const CommandExtensions& extensions) {
  return {with_flags<ApplyFlags>({.name = "apply",
                                  .description = "Apply many Boolean steps to a set, in tiles when that saves time",
                                  .operands = "File of the set to start from",
                                  .output = Output::kOptional},
                                 add_apply_options, [extensions](Session& session, const ApplyFlags& flags) {
                                   run_apply(session, flags, extensions);
                                 })};
}

}  // namespace nef
