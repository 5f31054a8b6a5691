// SPDX-License-Identifier: Apache-2.0
//
// nef subdivide
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/command/commands.h"
#include "nef/export/to_mesh.h"
#include "nef/remeshing/subdivide.h"

namespace nef {
namespace {

// A smoothed surface may cross itself; one with new vertices in its edges is the same surface.
void require_legal(const Mesh& mesh, const Monitor& monitor) {
  try {
    from_mesh(mesh, {.monitor = monitor});
  } catch (const InputError& error) {
    throw InputError(std::string("the smoothed surface bounds no solid (") + error.what() +
                     "): subdivide it by midpoints once before, or smooth it fewer times");
  }
}

}  // namespace

void add_subdivide_command(CLI::App& app, Session& session) {
  CLI::App* command = add_subcommand(
      app, session, "subdivide", "A mesh of more triangles for a solid: each in four, the same surface or smoothed");
  struct Flags {
    unsigned times = 1;
    std::string scheme = "midpoint";
  };
  const auto flags = std::make_shared<Flags>();
  command->add_option("input", session.input, "The set, as a file")->required();
  command->add_option("--times", flags->times, "How often; each time there are four times as many triangles")
      ->check(CLI::Range(1U, 12U))
      ->capture_default_str();
  command->add_option("--scheme", flags->scheme, "Midpoint keeps the surface, exactly; loop smooths it")
      ->check(CLI::IsMember({"midpoint", "loop"}))
      ->capture_default_str();
  add_input_flags(command, session);
  add_output_flags(command, session)->required();
  command->callback([&session, flags] {
    MeshExport whole = to_mesh(session.load(session.input), {}, session.monitor);
    if (whole.mesh.face_count() == 0)
      throw InputError("the set has no bounded solid part, so there is no mesh to subdivide");
    for (const std::string& line : whole.lost) session.note(line);
    const Stopwatch watch;
    const bool smooth = flags->scheme == "loop";
    const Mesh mesh =
        subdivide(whole.mesh, smooth ? SubdivisionScheme::kLoop : SubdivisionScheme::kMidpoint, flags->times);
    if (smooth) require_legal(mesh, session.monitor);
    const double seconds = watch.seconds();
    session.store_mesh(mesh, !smooth);
    session.say(std::to_string(mesh.face_count()) + " triangles");
    if (!session.json) return;
    session.spent("op", seconds);
    session.print("subdivide", {{"triangles", mesh.face_count()}, {"vertices", mesh.vertices.size()}});
  });
}

}  // namespace nef
