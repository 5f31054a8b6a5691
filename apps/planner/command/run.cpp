// SPDX-License-Identifier: Apache-2.0
//
// Which question is it? Each has a source of its own, which answers it, writes and prints.
#include "apps/planner/command/runs/runs.h"

#include <ompl/config.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "apps/planner/clearance/widest.h"
#include "apps/planner/command/ends.h"
#include "apps/planner/command/findings.h"
#include "apps/planner/command/report.h"
#include "apps/planner/rigid/pose_file.h"
#include "apps/program/numbers.h"
#include "apps/program/run_program.h"
#include "apps/program/version.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/number_text.h"

namespace nef::planner {
namespace {

Scene scene_of(const Arguments& a, const Monitor& monitor) {
  a.session.show_phase("reading " + a.scene);
  Scene scene = a.turn_freely ? freely_turning_scene(a.scene, a.session.mesh) : read_scene(a.scene, a.session.mesh);
  take_end(a.start, "--start", scene, false);
  take_end(a.goal, "--goal", scene, true);
  if (a.contact) scene.contact = *a.contact;
  if (!a.keep_clear.empty()) keep_clear(scene, parse_rational(a.keep_clear), monitor);
  a.session.note_all(scene.messages);
  return scene;
}

int run_with_scene(const Arguments& a, const TimeLimit& limit) {
  Scene scene = scene_of(a, limit.monitor());
  if (const std::optional<int> code = run_check_proof(a, scene)) return *code;
  if (!a.check_proof.empty() && (!scene.rotation || !a.given_path.empty())) {
    throw InputError("--check-proof " + a.check_proof +
                     ": this is not a file that --proof wrote; only for scenes with a rotation it may be a report");
  }
  std::vector<RigidPose> path;
  if (!a.given_path.empty()) path = read_path(a.given_path);
  if (std::any_of(path.begin(), path.end(), is_turned) || (scene.turns_freely && !path.empty())) {
    return run_certify(a, scene, path, limit);
  }
  const auto answer = [&](const nlohmann::json& widest, const TimeLimit& own) {
    if (scene.turns_freely) return run_rigid(a, scene, own);
    if (scene.rotation) return run_turning(a, scene, widest, own);
    return run_translations(a, scene, widest, path, own);
  };
  if (!a.widest && !a.widest_box) return answer({}, limit);
  const nlohmann::json widest = make_widest(a, scene);
  // The path at that size has the time once more.
  return answer(widest, TimeLimit(a.time, a.session.monitor));
}

// What the time was too short to read, or to prepare.
int tell_not_begun(const Arguments& a, const TimeLimit& limit) {
  const std::vector<std::array<std::string, 3>> kinds = {{"range", "mechanism", a.range},
                                                         {"assembly", "assembly", a.assembly},
                                                         {"linkage", "linkage", a.linkage},
                                                         {"plan", "scene", a.scene}};
  const auto& [command, key, file] =
      *std::find_if(kinds.begin(), kinds.end(), [](const auto& kind) { return !kind[2].empty(); });
  const auto report = [&key = key, &file = file] { return nlohmann::json{{key, file}, {"status", "undecided"}}; };
  tell(a, {command, file, report, {{"load", limit.passed(), {}}}, [] {
             std::cout << "undecided: the time limit (--time) was reached before the search began\n";
           }});
  return exit_code(AnswerStatus::kUndecided);
}

int run(const Arguments& a) {
  check_usage(a);
  // A planner of OMPL has the time for itself.
  const TimeLimit limit(a.ompl.empty() && a.benchmark.empty() ? a.time : std::nullopt, a.session.monitor);
  a.session.mesh.monitor = limit.monitor();
  if (!a.verdict.empty()) return run_verdict(a);
  try {
    if (!a.range.empty()) return run_range(a, limit);
    if (!a.assembly.empty()) return run_assembly(a, limit);
    if (!a.linkage.empty()) return run_linkage(a, limit);
    return run_with_scene(a, limit);
  } catch (const Interrupted&) {
    a.session.monitor.check_interruption();
    return tell_not_begun(a, limit);
  }
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
