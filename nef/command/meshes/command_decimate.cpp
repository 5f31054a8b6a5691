// SPDX-License-Identifier: Apache-2.0
//
// nef decimate
#include "nef/base/timing/stopwatch.h"
#include "nef/command/commands.h"
#include "nef/program/common_options.h"
#include "nef/remeshing/decimate.h"

namespace nef {

void add_decimate_command(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(app, session, "decimate",
                                     "A mesh of fewer triangles for a solid, legal still, and how far it is from it");
  const auto triangles = std::make_shared<std::size_t>(0);
  command->add_option("input", session.input, "The set, as a file")->required();
  command->add_option("--triangles", *triangles, "How many to aim at")->required()->check(positive());
  add_input_flags(command, session);
  add_output_flags(command, session)->required();
  command->callback([&session, triangles] {
    const Polyhedron set = session.load(session.input);
    const Stopwatch watch;
    const DecimatedMesh decimated = decimate(set, *triangles, session.monitor);
    const double seconds = watch.seconds();
    for (const std::string& line : decimated.notes) session.note(line);
    session.store_mesh(decimated.mesh, false);
    const auto [low, high] = decimated.distance;
    session.say(std::to_string(decimated.mesh.face_count()) + " triangles; Hausdorff distance " + Json(low).dump() +
                " to " + Json(high).dump());
    if (!session.json) return;
    session.spent("op", seconds);
    session.print("decimate", {{"triangles", decimated.mesh.face_count()},
                               {"vertices", decimated.mesh.vertices.size()},
                               {"distance", {{"low", low}, {"high", high}}}});
  });
}

}  // namespace nef
