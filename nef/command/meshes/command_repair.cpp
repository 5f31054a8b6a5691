// SPDX-License-Identifier: Apache-2.0
//
// nef repair
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "nef/command/commands.h"
#include "nef/import/repair.h"
#include "nef/io/file_bytes.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/program/common_options.h"

namespace nef {
namespace {

// Whether the output holds sets and no meshes.
bool is_set_file(const Session& session) {
  const std::string format = session.write_options().format;
  const std::string extension = format.empty() ? lower_extension(session.output) : format;
  return extension == "nef" || extension == "nef3";
}

// Nothing of a mesh that bounds no solid, unless it is to be written as it is.
void store(Session& session, const RepairedMesh& repaired) {
  const bool solid = repaired.problem.empty();
  if (repaired.resolved) return session.store(repaired.resolved->set);
  if (solid && is_set_file(session)) return session.store(from_mesh(repaired.mesh, {.monitor = session.monitor}));
  if (solid || session.mesh_file.lenient) session.store_mesh(repaired.mesh, solid);  // what rounding does is checked
}

// What the rule for crossings decided; null if nothing.
Json crossings_json(const RepairedMesh& repaired, Crossings rule) {
  if (!repaired.resolved) return nullptr;
  Json volumes = Json::array();
  for (const auto& [winding, entry] : repaired.resolved->volumes) {
    if (entry.parts == 0) continue;
    volumes.push_back({{"winding_number", winding},
                       {"parts", entry.parts},
                       {"volume", entry.measured.value},
                       {"volume_error", entry.measured.error},
                       {"taken", is_taken(rule, winding)}});
  }
  return {{"rule", name(rule)}, {"pairs", repaired.resolved->crossing_pairs}, {"volumes", volumes}};
}

Json holes_json(const RepairedMesh& repaired) {
  return {{"count", repaired.holes},
          {"flat", repaired.flat_holes},
          {"lid_share", std::isfinite(repaired.lid_share) ? Json(repaired.lid_share) : Json(nullptr)},
          {"closed", repaired.has_lids}};
}

// Which option has an answer to holes that are still there.
std::string advice(const RepairedMesh& repaired, const RepairOptions& options) {
  if (repaired.holes == 0 || repaired.has_lids) return "";
  const std::string holes = repaired.holes == 1 ? "its hole" : "its " + std::to_string(repaired.holes) + " holes";
  if (options.close_percent <= 0) return "; --close closes " + holes;
  const auto percent = std::min(100.0, std::ceil(100 * repaired.lid_share));
  return "; lids for " + holes + " are more than " + std::to_string(static_cast<int>(options.close_percent)) +
         " % of the area, --close=" + std::to_string(static_cast<int>(percent)) + " accepts them";
}

}  // namespace

void add_repair_command(CLI::App& app, Session& session) {
  CLI::App* command =
      add_subcommand(app, session, "repair",
                     "Make a mesh that nearly bounds a solid bound one, and say how. Exit code 0 if it does then, 1 if "
                     "not; then a file is written with --lenient only");
  const auto options = std::make_shared<RepairOptions>();
  command->add_option("input", session.input, "The mesh, as a file")->required();
  command->add_flag("--fill-holes", options->fill_holes, "Close planar holes with a face");
  command
      ->add_flag("--close{10}", options->close_percent,
                 "Close all holes, a guess: planar ones flat, others by triangles of least area. PERCENT is the "
                 "largest share of these lids in the area that is accepted; 10 if it is not given")
      ->type_name("[=PERCENT]")
      ->check(CLI::Range(0.0, 100.0).description(""));
  add_crossings_option(*command, options->crossings);
  add_output_flags(command, session)->required();
  command->callback([&session, options] {
    options->threads = session.threads;
    const RepairedMesh repaired = repair_mesh(read_mesh(session.input), *options, session.monitor);
    const bool solid = repaired.problem.empty();
    store(session, repaired);
    for (const std::string& line : repaired.done) session.say(line);
    session.say(solid ? (repaired.done.empty() ? "nothing to repair" : "the mesh bounds a solid now")
                      : "the mesh bounds no solid still: " + repaired.problem + advice(repaired, *options) +
                            (session.mesh_file.lenient ? "" : "; no file is written (--lenient writes what there is)"));
    session.exit_code = solid ? kYes : kNo;
    if (session.json) {
      session.print("repair", {{"ok", solid},
                               {"done", repaired.done},
                               {"holes", holes_json(repaired)},
                               {"crossings", crossings_json(repaired, options->crossings)},
                               {"problem", solid ? Json(nullptr) : Json(repaired.problem)}});
    }
  });
}

}  // namespace nef
