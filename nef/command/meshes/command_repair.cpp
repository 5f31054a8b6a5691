// SPDX-License-Identifier: Apache-2.0
//
// nef repair
#include "nef/command/commands.h"
#include "nef/import/repair.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/io/mesh/mesh_writer.h"

namespace nef {

void add_repair_command(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(
      app, session, "repair",
      "Make a mesh that nearly bounds a solid bound one, and say how. Exit code 0 if it does then, 1 if not");
  const auto options = std::make_shared<RepairOptions>();
  command->add_option("input", session.input, "The mesh, as a file")->required();
  command->add_flag("--fill-holes", options->fill_holes, "Close planar holes with a face");
  add_output_flags(command, session)->required();
  command->callback([&session, options] {
    const RepairedMesh repaired = repair_mesh(read_mesh(session.input), *options, session.monitor);
    if (repaired.problem.empty()) {
      session.store_mesh(repaired.mesh, true);  // what rounding does is checked
    } else {
      Messages notes;
      write_mesh(session.output, repaired.mesh, session.mesh_write_options(), &notes);
      session.note_all(notes);
    }
    for (const std::string& line : repaired.done) session.say(line);
    session.say(repaired.problem.empty() ? (repaired.done.empty() ? "nothing to repair" : "the mesh bounds a solid now")
                                         : "the mesh bounds no solid still: " + repaired.problem);
    session.exit_code = repaired.problem.empty() ? kYes : kNo;
    if (session.json) {
      session.print("repair", {{"ok", repaired.problem.empty()},
                               {"done", repaired.done},
                               {"problem", repaired.problem.empty() ? Json(nullptr) : Json(repaired.problem)}});
    }
  });
}

}  // namespace nef
