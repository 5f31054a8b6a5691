// SPDX-License-Identifier: Apache-2.0
//
// Options are declared in groups, and a table says which of them do not go together. What depends on the scene (a robot
// that turns, a path with rotations) is checked by the same functions once the scene is known.
#include "apps/planner/command/arguments.h"

#include <algorithm>
#include <iostream>
#include <string_view>

#include "apps/planner/ompl/ompl_planners.h"
#include "apps/program/common_options.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

constexpr const char* kFooter = R"TEXT(
A scene is JSON: {"robot": SHAPE, "obstacles": [SHAPE, ...], "start": [x, y, z], "goal": [x, y, z],
"box": [[x, y, z], [x, y, z]], "reference": [x, y, z], "contact": "allow"|"forbid",
"rotation": {"axis": "z" or [1, 2, 2], "range": [0, 360]} (then start and goal have a fourth number, degrees) or
"SO(3)" (then they are {"position": [x, y, z], "quaternion": [w, x, y, z]})}. SHAPE is the path of a mesh or nef file, or an expression such as "box(0,0,0, 9,3,3) - box(4,1,1, 5,2,2)". Numbers are exact:
0.1 is one tenth, "1/3" a third. OMPL.app's .cfg files are read too.

An assembly is {"parts": {"name": SHAPE, ...}, "rotation": ROTATION}, each part at its assembled place; with a
ROTATION, "SO(3)" or {"axis": "z" or [1, 2, 2]}, parts may also turn. A mechanism is {"moving": SHAPE,
"fixed": [SHAPE, ...], "joint": JOINT}, JOINT one of
{"type": "hinge", "axis": "z", "point": [x, y, z], "range": [0, 360]},
{"type": "slider", "direction": [0, 0, 1], "range": [0, 5]},
{"type": "screw", "axis": "z", "pitch": 1, "range": [0, 720]} and
{"type": "four-bar", "axis": "z", "pivots": [POINT, POINT], "pins": [POINT, POINT], "moves": "coupler"|"rocker",
"range": [0, 360]}.

Exit codes: 0 a path; 1 proof that there is none (with --path: the given path leaves free space);
2 bad input or usage; 3 start or goal is not free; 4 (--ompl only) no answer within the time; 5 undecided
(--time, --max-cells).
With --assembly: 0 a sequence, 1 inseparable, 3 parts overlap (or are closer than --keep-clear), 5 undecided.
With --range: 0, 5 undecided.
With --verdict: 0, 3 parts overlap, 5 a range is undecided.
With --linkage: 0 every motion of the path is free, 1 one collides, 5 undecided.
--manifold, --recenter and --lenient are for the meshes that --free-directions writes; .glb scenes and animations are always
placed about their middle.
--tight without -o lists passages and exits with 0 whatever the answer is. --queries exits with the largest code of
all queries.

Examples:
  planner scene.json -o path.json -o path.txt
  planner --tight scene.json
  planner scene.json --page scene.html -o scene.glb
  planner scene.json --prefer roomy --json
  planner scene.json --queries questions.txt --json
  planner scene.json --path given.path --proof given.proof
  planner scene.json --check-proof given.proof
  planner --assembly parts.json --page apart.html
  planner --range mechanism.json --json
  planner --verdict parts.json --json
  planner --linkage robot.urdf --srdf robot.srdf --obstacle table.off --path joints.txt --page motion.html
  planner scene.json --widest --precision 1/100
  planner scene.json --keep-clear 0.1 --speed 2 --acceleration 5 -o path.csv
  planner scene.json --ompl RRTConnect --time 5
  planner scene.json --benchmark bench.log --planners RRTConnect,PRMstar --runs 10)TEXT";

void declare_ompl(CLI::App& app, Arguments& a) {
  app.add_option(
      "--ompl", a.ompl,
      "Use this planner of OMPL on the exact free space, with samples from tight passages, too; of a robot that turns "
      "freely, from exact free spaces at rotations");
  app.add_option(
         "--time", a.time,
         "Seconds after which the answer is undecided, reading included; with --ompl or --benchmark, for each run of "
         "a planner")
      ->check(CLI::Range(1e-3, 1e6));
  app.add_option("--runs", a.runs, "Runs of each OMPL planner")->check(CLI::Range(1U, 1000000U));
  app.add_option("--benchmark", a.benchmark, "Compare this planner with --planners, and write OMPL's benchmark log");
  app.add_option("--planners", a.planners, "OMPL planners for --benchmark")->delimiter(',');
}

void declare_clearance(CLI::App& app, Arguments& a) {
  app.add_flag("--widest", a.widest,
               "Find the largest factor by which the robot can be scaled about its reference point and still pass");
  app.add_flag("--widest-box", a.widest_box,
               "Find the largest r so that the robot still passes when it is enlarged by the cube from -r to r");
  app.add_option("--precision", a.precision, "Relative width of the interval that --widest and --widest-box report")
      ->default_str("1/1000");
  app.add_option("--keep-clear", a.keep_clear,
                 "Keep at least this distance from all obstacles, or with --assembly from all parts that rest")
      ->type_name("D");
  app.add_option("--speed", a.limits.speed, "Speed of the reference point, for time stamps of way-points")
      ->check(nef::positive());
  app.add_option("--acceleration", a.limits.acceleration, "Its acceleration (default: unlimited); needs --speed")
      ->check(nef::positive());
}

// What the first option excludes.
struct Exclusion {
  const char* option;
  std::vector<const char*> others;
};

constexpr std::string_view kScene = "scene";

std::vector<Exclusion> exclusions() {
  return {
      {"--range",
       {kScene.data(), "--assembly", "--path", "--queries", "--tight", "--widest", "--widest-box", "--proof",
        "--check-proof", "--turn-freely"}},
      {"--verdict",
       {kScene.data(), "--assembly", "--range", "--path", "--queries", "--page", "--tight", "--widest", "--widest-box",
        "--proof", "--check-proof", "--time", "--turn-freely"}},
      {"--linkage",
       {kScene.data(), "--assembly",    "--range",  "--verdict",       "--queries",    "--start",  "--goal",
        "--contact",   "--tight",       "--widest", "--widest-box",    "--keep-clear", "--speed",  "--prefer",
        "--clearance", "--raw",         "--quick",  "--min-dimension", "--se3",        "--digits", "--max-cells",
        "--proof",     "--check-proof", "--ompl",   "--benchmark",     "--turn-freely"}},
      {"--assembly",
       {kScene.data(), "--start", "--goal", "--contact", "--tight", "--path", "--queries", "--ompl", "--benchmark",
        "--widest", "--widest-box", "--speed", "--prefer", "--clearance", "--raw", "--quick", "--min-dimension",
        "--se3", "--turn-freely"}},
      {"--free-directions", {"--digits", "--proof", "--check-proof", "--simultaneous", "--keep-clear"}},
      {"--benchmark", {"--ompl"}},
      {"--path", {"--ompl", "--benchmark"}},
      {"--queries", {"--path", "--page", "--ompl", "--benchmark"}},
      {"--widest", {"--widest-box", "--tight", "--path", "--queries", "--ompl", "--benchmark", "--check-proof"}},
      {"--widest-box", {"--tight", "--path", "--queries", "--ompl", "--benchmark", "--check-proof"}},
      {"--proof", {"--queries", "--benchmark", "--check-proof"}},
  };
}

std::string dotted(const std::vector<const char*>& extensions) {
  std::string text;
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    text += i == 0 ? "." : i + 1 == extensions.size() ? " or ." : ", .";
    text += extensions[i];
  }
  return text;
}

// Files of answers other than cones of directions, which are sets.
void check_outputs(const Arguments& a) {
  if (!a.range.empty()) require_extensions(a, "with --range", {"json", "html", "glb"});
  if (!a.verdict.empty()) require_extensions(a, "with --verdict", {"json"});
  if (!a.linkage.empty()) require_extensions(a, "with --linkage", {"json", "html", "glb"});
  if (!a.queries.empty()) require_extensions(a, "with --queries", {"json"});
  if (!a.assembly.empty()) require_extensions(a, "with --assembly", {"json", "html", "glb"});
  for (const std::string& file : a.outputs) {
    if (lower_extension(file) == "csv" && a.limits.speed <= 0) {
      throw InputError("-o " + file + ": time stamps need --speed");
    }
  }
  if (a.session.mesh_file.manifold || a.session.mesh_file.recenter || a.session.mesh_file.lenient) {
    throw InputError("--manifold, --recenter and --lenient are for the meshes that --free-directions writes");
  }
}

}  // namespace

void exclude(const Arguments& a, const std::string& what, const std::vector<const char*>& options) {
  for (const char* option : options) {
    if (a.app->count(option) > 0) throw InputError(what + " excludes " + (option == kScene ? "a scene" : option));
  }
}

void require_extensions(const Arguments& a, const std::string& where, const std::vector<const char*>& extensions) {
  for (const std::string& file : a.outputs) {
    const std::string extension = lower_extension(file);
    if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
      throw InputError("-o " + file + ": " + where + " the extension must be " + dotted(extensions));
    }
  }
}

void check_usage(const Arguments& a) {
  for (const auto& [option, others] : exclusions()) {
    if (a.app->count(option) > 0) exclude(a, option, others);
  }
  if (a.simultaneous && a.assembly.empty()) throw InputError("--simultaneous is for --assembly");
  if (!a.assembly.empty() && !a.keep_clear.empty())
    exclude(a, "--assembly with --keep-clear", {"--proof", "--check-proof"});
  if (a.exact && a.verdict.empty()) throw InputError("--exact is for --verdict");
  if (a.linkage.empty() && (!a.srdf.empty() || !a.obstacles.empty())) {
    throw InputError("--srdf and --obstacle are for --linkage");
  }
  if (!a.linkage.empty() && a.given_path.empty()) {
    throw InputError("--linkage needs --path FILE, a line of joint values for each way-point");
  }
  if (a.range.empty() && a.assembly.empty() && a.verdict.empty() && a.linkage.empty() && a.scene.empty()) {
    throw InputError("scene is required: planner SCENE, or planner --assembly PARTS.json");
  }
  if (!a.page.empty() && lower_extension(a.page) != "html") {
    throw InputError("--page " + a.page + ": the extension must be .html");
  }
  if (a.limits.acceleration > 0 && a.limits.speed <= 0) throw InputError("--acceleration needs --speed");
  if (!a.free_directions.empty()) {
    if (a.assembly.empty()) throw InputError("--free-directions needs --assembly");
  } else {
    check_outputs(a);
  }
  for (const std::string& name : a.planners) require_ompl_planner(name);
  if (!a.ompl.empty()) require_ompl_planner(a.ompl);
}

void declare(CLI::App& app, Arguments& a) {
  a.app = &app;
  app.add_option("scene", a.scene, "Scene (.json, or OMPL.app .cfg)")->type_name("FILE");
  app.add_option("--assembly", a.assembly,
                 "Take an assembly (.json) apart by translations, and turns if it has a rotation, or prove that it is "
                 "stuck")
      ->type_name("FILE");
  app.add_flag("--simultaneous", a.simultaneous,
               "With --assembly: where no set of parts can leave as one, try parts that move at once in different "
               "directions");
  app.add_option("--free-directions", a.free_directions,
                 "With --assembly: the exact cone of directions in which this part can begin to move")
      ->type_name("PART");
  app.add_option("--range", a.range,
                 "Find at which angles or strokes the moving part of a mechanism (.json) is free, touches or collides")
      ->type_name("FILE");
  app.add_option(
         "--verdict", a.verdict,
         "Check the parts of an assembly or a mechanism (.json) where they are: overlaps, gaps, contacts, which "
         "parts can be removed, and the range of motion")
      ->type_name("FILE");
  app.add_option(
         "--linkage", a.linkage,
         "With --path: certify motions of a robot of several links (.urdf); the path has a line of joint values "
         "for each way-point")
      ->type_name("FILE");
  app.add_option("--srdf", a.srdf, "With --linkage: the SRDF file whose disable_collisions are not compared")
      ->type_name("FILE");
  app.add_option("--obstacle", a.obstacles, "With --linkage: an obstacle, as in scenes; may be repeated")
      ->type_name("SHAPE")
      ->expected(1)
      ->take_all();
  app.add_flag("--exact", a.exact, "With --verdict: exact volumes of overlaps, which may have thousands of digits");
  app.add_option("-o,--output", a.outputs,
                 "Write the answer: .json report, .path (OMPL matrix), .glb (animated glTF), .csv (time stamps), else "
                 "text; may be repeated")
      ->type_name("FILE");
  app.add_option("--page", a.page, "Write a page (.html) that plays the motion")->type_name("FILE");
  app.add_flag("--tight", a.tight, "List all tight passages; with --path, also name those that the path uses");
  app.add_option("--path", a.given_path,
                 "Check this path (a report or lines of numbers) instead of searching for one; lines x y z qx qy qz "
                 "qw turn the robot")
      ->type_name("FILE");
  app.add_option("--queries", a.queries, "Answer many queries: start and goal as six numbers per line (or JSON)")
      ->type_name("FILE");
  app.add_option("--start", a.start,
                 "Start to use instead of the scene's; for a robot that turns, followed by degrees or by qw,qx,qy,qz")
      ->type_name("X,Y,Z");
  app.add_option("--goal", a.goal, "Goal to use instead of the scene's")->type_name("X,Y,Z");
  app.add_flag("--turn-freely", a.turn_freely,
               "Let the robot of a .cfg file turn about all axes, as in OMPL.app, whatever its start and goal");
  const auto take_contact = [&a](const std::string& rule) {
    a.contact = rule == "allow" ? ContactRule::kAllow : ContactRule::kForbid;
  };
  app.add_option_function<std::string>("--contact", take_contact, "Whether the robot may touch obstacles")
      ->check(CLI::IsMember({"allow", "forbid"}));
  app.add_option_function<std::string>(
         "--prefer", [&a](const std::string& kind) { a.path.roomy = kind == "roomy"; },
         "short: use any passage; roomy: use thin passages only where necessary")
      ->check(CLI::IsMember({"short", "roomy"}));
  app.add_option("--min-dimension", a.path.min_dimension, "Stay where free space has at least this dimension")
      ->check(CLI::Range(0, 3));
  app.add_flag("--raw", a.path.raw, "Keep the way-points of the roadmap, without shortcuts");
  app.add_flag("!--quick", a.path.thorough,
               "Take the first path found and shorten it a little, instead of comparing several");
  app.add_option("--digits", a.path.digits, "Round way-points to this many decimals where the motions stay free")
      ->check(CLI::Range(0U, 300U));
  app.add_flag("--clearance", a.path.clearance, "Prefer way-points inside volumes to way-points in contact");
  app.add_flag("--se3", a.se3, "Write path matrices with seven columns x y z qx qy qz qw");
  app.add_option(
      "--max-cells", a.max_cells,
      "For a robot that turns, or each set of parts of an assembly that turns: use at most this many cells of angles, "
      "slices if it turns freely, or boxes of poses in a proof");
  app.add_option(
         "--proof", a.proof,
         "Write a proof (.proof) that the path is free, that it collides, or that there is none; with --tight, that "
         "passages are tight; with --assembly, that nothing can begin to move")
      ->type_name("FILE");
  app.add_option(
         "--check-proof", a.check_proof,
         "Verify a .proof file (for a robot that turns, the report with the proof) against the scene or assembly; "
         "exit code 0: the proof holds, 1: it fails")
      ->type_name("FILE");
  declare_clearance(app, a);
  declare_ompl(app, a);
  add_crossings_option(app, a.session.mesh.crossings);
  add_close_option(app, a.session.mesh.close_percent);
  add_manifold_option(app, a.session.mesh_file.manifold);
  add_mesh_file_options(app, a.session.mesh_file);
  add_run_flags(&app, a.session);
  app.footer(kFooter);
}

}  // namespace nef::planner
