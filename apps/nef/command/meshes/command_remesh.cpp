// SPDX-License-Identifier: Apache-2.0
//
// nef decimate | subdivide
#include "apps/nef/command/commands.h"
#include "apps/program/common_options.h"
#include "apps/remeshing/decimate.h"
#include "apps/remeshing/subdivide.h"
#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/export/to_mesh.h"

namespace nef {
namespace {

void run_decimate(Session& session, std::size_t triangles) {
  const Polyhedron set = session.load(session.input);
  const Stopwatch watch;
  const DecimatedMesh decimated = decimate(set, triangles, session.monitor);
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
}

struct SubdivideFlags {
  unsigned times = 1;
  std::string scheme = "midpoint";
};

// A smoothed surface may cross itself; one with new vertices in its edges is the same surface.
void require_legal(const Mesh& mesh, const Monitor& monitor) {
  try {
    from_mesh(mesh, {.monitor = monitor});
  } catch (const InputError& error) {
    throw InputError(std::string("the smoothed surface does not bound a solid (") + error.what() +
                     "); subdivide once with --scheme midpoint first, or smooth it fewer times");
  }
}

void add_subdivide_options(CLI::App& command, Session&, SubdivideFlags& flags) {
  command.add_option("--times", flags.times, "Number of subdivisions; each multiplies the triangles by four")
      ->check(CLI::Range(1U, 12U))
      ->capture_default_str();
  command.add_option("--scheme", flags.scheme, "midpoint keeps the surface exactly; loop smooths it")
      ->check(CLI::IsMember({"midpoint", "loop"}))
      ->capture_default_str();
}

void run_subdivide(Session& session, const SubdivideFlags& flags) {
  MeshExport whole = to_mesh(session.load(session.input), {}, session.monitor);
  if (whole.mesh.face_count() == 0)
    throw InputError("the set has no bounded solid part, so there is no mesh to subdivide");
  for (const std::string& line : whole.lost) session.note(line);
  const Stopwatch watch;
  const bool smooth = flags.scheme == "loop";
  const Mesh mesh =
      subdivide(whole.mesh, smooth ? SubdivisionScheme::kLoop : SubdivisionScheme::kMidpoint, flags.times);
  if (smooth) require_legal(mesh, session.monitor);
  const double seconds = watch.seconds();
  session.store_mesh(mesh, !smooth);
  session.say(std::to_string(mesh.face_count()) + " triangles");
  if (!session.json) return;
  session.spent("op", seconds);
  session.print("subdivide", {{"triangles", mesh.face_count()}, {"vertices", mesh.vertices.size()}});
}

}  // namespace

Commands mesh_commands() {
  return {
      with_flags<std::size_t>(
          {.name = "decimate",
           .description = "Simplify a solid to a valid mesh with fewer triangles, and report how far apart the two are",
           .output = Output::kRequired},
          [](CLI::App& command, Session&, std::size_t& triangles) {
            command.add_option("--triangles", triangles, "Number of triangles to aim for")
                ->required()
                ->check(positive());
          },
          run_decimate),
      with_flags<SubdivideFlags>(
          {.name = "subdivide",
           .description = "Split each triangle of a solid into four, on the same surface or smoothed",
           .output = Output::kRequired},
          add_subdivide_options, run_subdivide)};
}

}  // namespace nef
