// SPDX-License-Identifier: Apache-2.0
//
// nef repair
#include "nef/command/commands.h"
#include "nef/import/repair.h"
#include "nef/io/mesh/mesh_reader.h"

namespace nef {

void add_repair_command(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "repair",
                                     "Make a mesh that nearly bounds a solid bound one, and say how. Exit code 0 if it "
                                     "does then, 1 if not; then a file "
                                     "is written with --lenient only");
  const auto options = std::make_shared<RepairOptions>();
  command->add_option("input", session.input, "The mesh, as a file")->required();
  command->add_flag("--fill-holes", options->fill_holes, "Close planar holes with a face");
  add_output_flags(command, session)->required();
  command->callback([&session, options] {
    const RepairedMesh repaired = repair_mesh(read_mesh(session.input), *options, session.monitor);
    const bool solid = repaired.problem.empty();
    if (solid || session.mesh_file.lenient) session.store_mesh(repaired.mesh, solid);  // what rounding does is checked
    for (const std::string& line : repaired.done) session.say(line);
    session.say(solid ? (repaired.done.empty() ? "nothing to repair" : "the mesh bounds a solid now")
                      : "the mesh bounds no solid still: " + repaired.problem +
                            (session.mesh_file.lenient ? "" : "; no file is written (--lenient writes what there is)"));
    session.exit_code = solid ? kYes : kNo;
    if (session.json) {
      session.print(
          "repair",
          {{"ok", solid}, {"done", repaired.done}, {"problem", solid ? Json(nullptr) : Json(repaired.problem)}});
    }
  });
}

}  // namespace nef
