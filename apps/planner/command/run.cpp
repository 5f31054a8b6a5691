// SPDX-License-Identifier: Apache-2.0
//
// Which question is it? Each has a source of its own, which answers it, writes and prints.
#include "apps/planner/command/runs/runs.h"

#include <ompl/config.h>

#include <algorithm>
#include <iostream>

#include "apps/planner/clearance/widest.h"
#include "apps/planner/command/ends.h"
#include "apps/planner/rigid/pose_file.h"
#include "apps/program/numbers.h"
#include "apps/program/run_program.h"
#include "apps/program/version.h"
#include "nef/base/error.h"
#include "nef/io/number_text.h"

namespace nef::planner {
namespace {

Scene scene_of(const Arguments& a) {
  a.session.show_phase("reading " + a.scene);
  Scene scene = read_scene(a.scene, a.session.mesh);
  take_end(a.start, "--start", scene, false);
  take_end(a.goal, "--goal", scene, true);
  if (a.contact) scene.contact = *a.contact;
  if (!a.keep_clear.empty()) keep_clear(scene, parse_rational(a.keep_clear), a.session.monitor);
  a.session.note_all(scene.messages);
  return scene;
}

int run(const Arguments& a) {
  check_usage(a);
  a.session.mesh.monitor = a.session.monitor;
  if (!a.range.empty()) return run_range(a);
  if (!a.verdict.empty()) return run_verdict(a);
  if (!a.assembly.empty()) return run_assembly(a);
  if (!a.linkage.empty()) return run_linkage(a);
  Scene scene = scene_of(a);
  if (const std::optional<int> code = run_check_proof(a, scene)) return *code;
  if (!a.check_proof.empty() && (!scene.rotation || !a.given_path.empty())) {
    throw InputError("--check-proof " + a.check_proof +
                     ": this is not a file that --proof wrote; only for scenes with a rotation it may be a report");
  }
  std::vector<RigidPose> path;
  if (!a.given_path.empty()) path = read_path(a.given_path);
  if (std::any_of(path.begin(), path.end(), is_turned) || (scene.turns_freely && !path.empty())) {
    return run_certify(a, scene, path);
  }
  nlohmann::json widest;
  if (a.widest || a.widest_box) widest = make_widest(a, scene);
  if (scene.turns_freely) return run_rigid(a, scene);
  if (scene.rotation) return run_turning(a, scene, widest);
  return run_translations(a, scene, widest, path);
}

}  // namespace

int run_command(int argc, char** argv) {
  CLI::App app("Plans motions among obstacles exactly: finds a path, or proves that there is none.", "planner");
  app.set_version_flag("--version", version_text("planner", {"OMPL " OMPL_VERSION}));
  Session session("planner", std::cout, std::cerr);
  const ProgressFunction show = [&session](const char* phase, std::size_t done, std::size_t total) {
    session.show_phase(phase, done, total);
  };
  session.monitor = session.monitor.telling(show);
  Arguments arguments(session);
  declare(app, arguments);
  return run_program(
      app, argc, argv, [&] { return run(arguments); }, [&](const std::string& line) { session.complain(line); });
}

}  // namespace nef::planner
