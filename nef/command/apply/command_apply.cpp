// SPDX-License-Identifier: Apache-2.0
//
// nef apply
#include <filesystem>

#include "nef/base/error.h"
#include "nef/base/stopwatch.h"
#include "nef/command/apply/steps_file.h"
#include "nef/command/commands.h"
#include "nef/io/file_bytes.h"

namespace nef {
namespace {

struct ApplyFlags {
  std::string steps;
  std::string tiles = "auto";
};

struct TileChoice {
  TileUse use = TileUse::kWherePays;
  Tiling tiling;
};

TileChoice tile_choice(const std::string& word, unsigned threads) {
  TileChoice result;
  result.tiling.threads = threads;
  if (word == "auto") return result;
  result.use = TileUse::kNever;
  if (word == "off") return result;
  constexpr std::size_t kFewest = 32;  // a box with a corner cut off in each corner
  std::size_t end = 0;
  try {
    result.tiling.limit = std::stoul(word, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  if (end == 0 || end != word.size() || word[0] == '-' || result.tiling.limit < kFewest) {
    throw InputError("--tiles takes auto, off or the number of vertices that a tile may have, at least " +
                     std::to_string(kFewest) + "; not '" + word + "'");
  }
  result.use = TileUse::kAlways;
  return result;
}

Polyhedron apply_steps(const std::vector<BooleanStep>& steps, const std::string& path, const TileChoice& tiles,
                       Session& session, const ExpressionOptions& options, Json& report) {
  StepSequence sequence(session.load(session.input), steps.size(), tiles.use, tiles.tiling);
  report = Json::array();
  for (const BooleanStep& step : steps) {
    session.show_phase("steps", report.size(), steps.size());
    const Polyhedron operand = operand_of(step, path, options);
    const Stopwatch watch;
    sequence.apply(step.op, operand);
    Json entry;
    entry["line"] = step.line;
    entry["operator"] = std::string(1, step.symbol);
    entry["op_s"] = watch.seconds();
    entry["tiles"] = sequence.tile_count() == 0 ? Json() : Json(sequence.tile_count());
    report.push_back(std::move(entry));
  }
  session.show_phase("gluing");
  return sequence.result();
}

}  // namespace

void add_apply_command(CLI::App& app, Session& session, const CommandExtensions& extensions) {
  CLI::App* command = add_subcommand(app, session, "apply", "A set changed by many steps, in tiles where that pays");
  const auto flags = std::make_shared<ApplyFlags>();
  command->add_option("input", session.input, "The set to begin with, as a file")->required();
  command->add_option("--steps", flags->steps, "A file with one operator and expression a line; - for standard input")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--tiles", flags->tiles,
                   "Vertices that a tile may have; off: none; auto: tiles where the steps are small and many")
      ->type_name("N|off|auto")
      ->capture_default_str();
  add_input_flags(command, session);
  add_output_flags(command, session);
  command->footer(
      "A step is one line: + A (union), - A (difference), * A (intersection) or ^ A (symmetric difference), where A "
      "is\n"
      "an expression as in nef eval; files in it are relative to the file of steps. '#' begins a comment.\n"
      "  - box(0,0,0, 1,1,1)\n"
      "  + translate(file(\"boss.off\"), 3,0,0)   # a comment\n"
      "Output is in canonical order: the same bytes whatever --tiles and --threads. --json tells the seconds of each\n"
      "step and the number of tiles after it.");
  command->callback([&session, flags, extensions] {
    const TileChoice tiles = tile_choice(flags->tiles, session.threads);
    const std::vector<BooleanStep> steps = parse_steps(read_file(flags->steps), flags->steps);
    const std::filesystem::path folder = std::filesystem::path(flags->steps).parent_path();
    ExpressionOptions options;
    options.load = [&session, folder](const std::string& file) { return session.load((folder / file).string()); };
    options.minkowski = extensions.minkowski;
    options.ball = extensions.ball;
    options.hull = extensions.hull;
    Json report;
    const Measured measured =
        measure(1, [&] { return apply_steps(steps, flags->steps, tiles, session, options, report); });
    finish(session, "apply", measured, {{"steps", std::move(report)}});
  });
}

}  // namespace nef
