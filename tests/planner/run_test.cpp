// SPDX-License-Identifier: Apache-2.0
//
// The command `planner` as users call it, the readers of scenes, and the example program (apps/planner/examples/).
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "apps/program/reports/exact_json.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_writer.h"
#include "nef/io/polyhedron_file.h"
#include "nef/polyhedron.h"
#include "nef/tiles/storage/tile_folder.h"
#include "nef/tiles/tiled_polyhedron.h"
#include "nef/version.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/paths.h"
#include "tests/support/report_shape.h"
#include "tests/support/shapes/machine_parts.h"

namespace nef::planner::test {
namespace {

TEST_CASE("exit codes and the JSON report") {
  const Folder folder;
  const Run path = planner(folder, scene("s1_tight_hole") + " --json");
  CHECK(path.code == 0);
  const auto report = nlohmann::json::parse(path.out);
  CHECK(report["status"] == "path");
  CHECK(report["path"][1] == nlohmann::json({"3", "1", "1"}));
  CHECK(report["path_double"][3] == nlohmann::json({7.0, 1.5, 1.5}));
  CHECK(report["length"].get<double>() == Approx(6.242640687));
  CHECK(report["cells"] == nlohmann::json({3, 1, 3}));
  CHECK(report["thinnest_piece"] == 1);
  CHECK(report["thinnest_junction"] == 0);
  CHECK(report["components"].size() == 2);
  CHECK(report["tight"][0]["dimension"] == 1);
  CHECK(report["phases"].contains("configuration_space_s"));
  nef::test::check_report_shape(report, "plan");

  const Run no = planner(folder, scene("s1_narrower") + " --json");
  CHECK(no.code == 1);
  CHECK(nlohmann::json::parse(no.out)["status"] == "infeasible");

  const Run start = planner(folder, scene("s1_tight_hole") + " --json --start 3.5,1,0.5");
  CHECK(start.code == 3);
  const auto bad = nlohmann::json::parse(start.out);
  CHECK(bad["status"] == "invalid_start");
  CHECK(bad["collision"]["obstacle"] == 1);
  CHECK(nlohmann::json::parse(planner(folder, scene("s1_tight_hole") + " --json --goal 4,0,1").out)["status"] ==
        "invalid_goal");
  CHECK(planner(folder, scene("s1_tight_hole") + " --contact forbid").code == 1);
}

TEST_CASE("where nothing is in the way, a path with clearance goes straight, too") {
  const Folder folder;
  const std::string nothing = folder.write("nothing.json", R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": [],
      "start": [-2, 0, 0], "goal": [2, 0, 0]})J");
  for (const char* options : {"", " --clearance", " --quick --clearance"}) {
    const Run run = planner(folder, nothing + options);
    CHECK(run.code == 0);
    CHECK_THAT(run.out, Catch::Contains("length 4,"));
  }
}

TEST_CASE("when --time is up, a question about translations is undecided") {
  const Folder folder;
  // Read in a hundredth of a second; the sum takes several times as long as the limit.
  write_mesh(folder.file("gear.off"), nef::test::extruded_part(nef::test::gear_outline(125, 1000, 100), 100));
  const std::string slow = folder.write("slow.json", R"J({"robot": "gear.off", "obstacles": ["gear.off"],
      "start": [5000,0,0], "goal": [-5000,0,0]})J");
  const Run late = planner(folder, slow + " --time 4 --json");
  CHECK(late.code == 5);
  const auto report = nlohmann::json::parse(late.out);
  CHECK(report["status"] == "undecided");
  CHECK(report["motions"] == "translation");
  nef::test::check_report_shape(report, "plan");
  CHECK(planner(folder, slow + " --time 4").out.find("undecided: the time limit (--time) was reached\n") == 0);
  CHECK(planner(folder, scene("s1_tight_hole") + " --time 1000").code == 0);
  CHECK(planner(folder, scene("s1_narrower") + " --time 1000").code == 1);
}

TEST_CASE("the time limit includes reading, whatever is asked") {
  const Folder folder;
  const std::string heavy = "sphere(2, 300)";  // takes longer than the time
  const std::string ends = R"J(, "start": {"position": [5,0,0], "quaternion": [1,0,0,0]},
      "goal": {"position": [-5,0,0], "quaternion": [1,0,0,0]}})J";
  const std::string shapes = R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": [")J" + heavy + R"J("])J";
  const std::vector<std::pair<std::string, std::string>> asked = {
      {"plan", folder.write("plan.json", shapes + R"J(, "start": [5,0,0], "goal": [-5,0,0]})J")},
      {"plan", folder.write("rigid.json", shapes + R"J(, "rotation": "SO(3)")J" + ends)},
      {"assembly", "--assembly " + folder.write("parts.json", R"J({"parts": {"a": ")J" + heavy +
                                                                  R"J(", "b": "box(3,0,0, 4,1,1)"}})J")},
      {"range", "--range " + folder.write("hinge.json", R"J({"moving": "box(0,0,0, 1,1,1)", "fixed": [")J" + heavy +
                                                            R"J("], "joint": {"type": "hinge", "axis": "z",
                                                            "range": [0, 90]}})J")}};
  for (const auto& [command, arguments] : asked) {
    CAPTURE(arguments);
    const Run late = planner(folder, arguments + " --time 0.01");
    CHECK(late.code == 5);
    CHECK(late.out == "undecided: the time limit (--time) was reached before the search began\n");
    const auto report = nlohmann::json::parse(planner(folder, arguments + " --time 0.01 --json").out);
    CHECK(report["status"] == "undecided");
    nef::test::check_report_shape(report, command);
  }
}

TEST_CASE("an end that is not free is told before any free space is made") {
  const Folder folder;
  const std::string bad = scene("s1_tight_hole") + " --start 3.5,1,0.5";
  const auto report = nlohmann::json::parse(planner(folder, bad + " --json").out);
  CHECK(report["status"] == "invalid_start");
  CHECK_FALSE(report["phases"].contains("configuration_space_s"));
  for (const char* key : {"components", "tight", "touching"}) CHECK(report[key].is_null());
  nef::test::check_report_shape(report, "plan");
  // What is asked about free space needs it all the same, and says the same about the start.
  const Run all = planner(folder, bad + " --json --page " + folder.file("page.html"));
  CHECK(all.code == 3);
  const auto whole = nlohmann::json::parse(all.out);
  CHECK(whole["phases"].contains("configuration_space_s"));
  CHECK(whole["collision"] == report["collision"]);
  CHECK(planner(folder, bad).out == planner(folder, bad + " --page " + folder.file("page.html")).out);
  // A robot that turns, too: before its range is cut.
  const Run turned = planner(folder, scene("corner") + " --start 0,5,0,0 --json");
  CHECK(turned.code == 3);
  CHECK(nlohmann::json::parse(turned.out)["cells"] == 0);
}

TEST_CASE("a folder of tiles is a shape like the file of its set") {
  const Folder folder;
  const Polyhedron wall = subtract(make_box({4, 0, 0}, {5, 3, 3}), make_box({4, 1, 1}, {5, 2, 2}));
  write_polyhedron(folder.file("wall.nef"), wall);
  write_tiles(folder.file("wall.tiles"), TiledPolyhedron(wall, {.limit = 32}));
  const auto asked = [&](const std::string& obstacle) {
    const std::string scene =
        folder.write("scene.json", R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": [")J" + obstacle +
                                       R"J("], "box": [[0,0,0], [9,3,3]], "contact": "allow",
      "start": [1, "1/2", "1/2"], "goal": [7, 1, 1]})J");
    const Run run = planner(folder, scene + " --json");
    CHECK(run.code == 0);
    return nlohmann::json::parse(run.out)["path"];
  };
  CHECK(asked("wall.tiles") == asked("wall.nef"));
}

TEST_CASE("notes about the input are printed on stderr, whatever is asked") {
  const Folder folder;
  // A cube whose faces all occur twice.
  std::string off = "OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
  for (int twice = 0; twice < 2; ++twice) {
    off += "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  }
  static_cast<void>(folder.write("twice.off", off));
  const std::string plain = folder.write("noted.json", R"J({"robot": "twice.off", "obstacles": ["box(4,0,0, 5,9,9)"],
    "box": [[0,0,0], [8,12,8]], "start": [1,1,1], "goal": [6,1,1]})J");
  const std::string queries = folder.write("queries.txt", "1 1 1 6 1 1\n");
  const std::string path = folder.write("path.txt", "1 1 1\n1 2 1\n");
  const std::string parts = folder.write("parts.json", R"J({"parts": {"a": "twice.off", "b": "box(3,0,0, 4,1,1)"}})J");
  for (const std::string& arguments :
       {plain, plain + " --tight", plain + " --queries " + queries, plain + " --path " + path,
        plain + " --widest --precision 1", "--assembly " + parts, "--assembly " + parts + " --free-directions a"}) {
    INFO(arguments);
    const Run run = planner(folder, arguments);
    CHECK(run.code < 2);
    CHECK_THAT(run.err, Catch::StartsWith("planner: note: ") && Catch::Contains("enclosed at least once"));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK(run.out.find("note:") == std::string::npos);
    CHECK(planner(folder, arguments + " --quiet").err.empty());
    const Run report = planner(folder, arguments + " --json");
    CHECK(report.err == run.err);
    CHECK_THAT(nlohmann::json::parse(report.out)["messages"][0].get<std::string>(),
               Catch::Contains("enclosed at least once"));
  }
}

TEST_CASE("the cone of free directions is a mesh like those of other programs") {
  const Folder folder;
  const std::string parts =
      folder.write("parts.json", R"J({"parts": {"a": "box(0,0,0, 1,1,1)", "b": "box(1,0,0, 2,1,1)"}})J");
  const std::string cone = folder.file("cone.off");
  const std::string question = "--assembly " + parts + " --free-directions a -o " + cone;
  const Run plain = planner(folder, question + " --json");
  CHECK(plain.code == 0);
  CHECK_FALSE(nlohmann::json::parse(plain.out).contains("offsets"));
  // The half of the cube from -1 to 1 with x <= 0; its middle is at x = -1/2, and its longest side is 2.
  const Polyhedron half = make_box({-1, -1, -1}, {0, 1, 1});
  CHECK(equal(read_polyhedron(cone), half));
  const Run moved = planner(folder, question + " --recenter --manifold --json");
  CHECK(moved.code == 0);
  CHECK(nlohmann::json::parse(moved.out).value("offsets", nlohmann::json::object()).size() <= 1);
  const Run far = planner(folder, scene("s1_tight_hole") + " --recenter");
  CHECK(far.code == 2);
  CHECK_THAT(far.err, Catch::Contains("--free-directions"));
}

TEST_CASE("paths in all formats, and reading them back with their passages") {
  const Folder folder;
  const std::string outputs =
      " -o " + folder.file("p.json") + " -o " + folder.file("p.txt") + " -o " + folder.file("p.path");
  REQUIRE(planner(folder, scene("s1_tight_hole") + outputs).code == 0);
  CHECK(text_of(folder.file("p.txt")) == "1 0.5 0.5\n3 1 1\n5 1 1\n7 1.5 1.5\n");
  CHECK(text_of(folder.file("p.path")) == "1 0.5 0.5 \n3 1 1 \n5 1 1 \n7 1.5 1.5 \n\n");
  REQUIRE(planner(folder, scene("s1_tight_hole") + " --se3 -o " + folder.file("q.path")).code == 0);
  CHECK(text_of(folder.file("q.path")).substr(0, 21) == "1 0.5 0.5 0 0 0 1 \n3 ");
  for (const char* name : {"p.json", "p.txt", "p.path"}) {
    const Run run = planner(folder, scene("s1_tight_hole") + " --tight --path " + folder.file(name));
    CHECK(run.code == 0);
    CHECK(run.out.find("uses passages: 0") != std::string::npos);
  }
  const std::string straight = folder.write("straight.txt", "1 0.5 0.5\n7 1.5 1.5\n");
  CHECK(planner(folder, scene("s1_tight_hole") + " --path " + straight).code == 1);
  const Run blocked = planner(folder, scene("s1_tight_hole") + " --json --path " + straight);
  CHECK(blocked.code == 1);
  const auto why = nlohmann::json::parse(blocked.out);
  CHECK(why["status"] == "blocked");
  CHECK(why["blocked_segment"] == 0);
  CHECK(why["collision"]["obstacle"] == 1);
  const std::string still = folder.write("still.txt", "1 0.5 0.5\n1 1 1\n");
  CHECK_THAT(planner(folder, scene("s1_tight_hole") + " --tight --path " + still).out,
             Catch::Contains("uses passages: none"));
  const Run tight = planner(folder, "--tight " + scene("s2_tight_slot"));
  CHECK(tight.code == 0);
  CHECK(tight.out.find("passage 0: dimension 2") == 0);
  CHECK(planner(folder, scene("s1_tight_hole") + " --quiet").out.empty());
}

// The JSON of a binary glTF file.
nlohmann::json gltf_of(const std::string& file) {
  const std::string bytes = text_of(file);
  REQUIRE(bytes.substr(0, 4) == "glTF");
  const auto at = [&bytes](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes.at(i))); };
  return nlohmann::json::parse(bytes.substr(20, at(12) | at(13) << 8 | at(14) << 16));
}

TEST_CASE("a glTF file with a robot that moves, without a path it stands still") {
  const Folder folder;
  REQUIRE(planner(folder, scene("s1_tight_hole") + " -o " + folder.file("s1.glb")).code == 0);
  const auto moving = gltf_of(folder.file("s1.glb"));
  REQUIRE(moving["animations"].size() == 1);
  const auto& channel = moving["animations"][0]["channels"][0];
  CHECK(channel["target"]["path"] == "translation");
  CHECK(moving["nodes"][channel["target"]["node"].get<std::size_t>()]["name"] == "robot");
  const auto& times = moving["accessors"][moving["animations"][0]["samplers"][0]["input"].get<std::size_t>()];
  CHECK(times["count"] == 4);
  CHECK(times["min"][0] == 0);
  CHECK(times["max"][0] == 10);
  std::vector<std::string> names;
  for (const auto& node : moving["nodes"]) names.push_back(node["name"]);
  for (const char* name : {"obstacles", "tight passages", "free space", "path", "robot at the goal"}) {
    CHECK(std::count(names.begin(), names.end(), name) >= 1);
  }
  CHECK(planner(folder, scene("s1_narrower") + " -o " + folder.file("no.glb")).code == 1);
  CHECK_FALSE(gltf_of(folder.file("no.glb")).contains("animations"));
}

TEST_CASE("The option --tight lists and exits with 0 whatever the answer, unless a path is asked for too") {
  const Folder folder;
  const Run no = planner(folder, "--tight " + scene("s1_narrower"));
  CHECK(no.code == 0);
  CHECK(no.out == "no tight passage\n");
  const Run both = planner(folder, "--tight --json " + scene("s1_narrower"));
  CHECK(both.code == 0);
  CHECK(nlohmann::json::parse(both.out)["tight"].empty());
  CHECK(planner(folder, "--tight " + scene("s1_narrower") + " -o " + folder.file("no.txt")).code == 1);
  CHECK_FALSE(std::filesystem::exists(folder.file("no.txt")));
  const std::string ends = folder.write(
      "no_ends.json", R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(0,0,0, 3,3,1)", "box(0,0,2, 3,3,3)"]})J");
  const Run listed = planner(folder, "--tight " + ends);
  CHECK(listed.code == 0);
  CHECK(listed.out.find("passage 0: dimension 2") == 0);
  CHECK_THAT(listed.out, Catch::Contains("  mouth "));
  CHECK(planner(folder, "--tight " + ends + " -o " + folder.file("tight.json")).code == 0);
  const auto report = nlohmann::json::parse(text_of(folder.file("tight.json")));
  CHECK(report["status"] == "free_space");
  CHECK(report["tight"][0]["dimension"] == 2);
  for (const char* how : {"", " --benchmark x.log", " --ompl RRT"}) {
    const Run without = planner(folder, ends + how);
    CHECK(without.code == 2);
    CHECK_THAT(without.err, Catch::Contains("has no start"));
  }
}

TEST_CASE("flags that all programs have") {
  const Folder folder;
  CHECK_THAT(planner(folder, "--version").out, Catch::StartsWith("planner " NEF_VERSION) && Catch::Contains(", OMPL "));
  const std::string help = planner(folder, "--help").out;
  for (const char* word :
       {"--page", "--threads", "--quiet", "--json", "--tight", "--ompl", "--benchmark", "Exit codes"}) {
    CHECK_THAT(help, Catch::Contains(word));
  }
  const auto without_times = [](const Run& run) {
    auto report = nlohmann::json::parse(run.out);
    report.erase("phases");
    report.erase("peak_memory_bytes");
    return report;
  };
  const std::string ask = scene("s9_gate_and_rail") + " --json --threads ";
  CHECK(without_times(planner(folder, ask + "1")) == without_times(planner(folder, ask + "3")));
  CHECK(planner(folder, scene("s1_narrower") + " --quiet").out.empty());
  CHECK(planner(folder, scene("s1_narrower") + " --quiet").code == 1);
  CHECK(planner(folder, scene("s1_tight_hole") + " --quiet --json").code == 0);
}

TEST_CASE("long work tells how far it is") {
  const Scene rail = load("s9_gate_and_rail");
  std::vector<std::string> phases;
  std::size_t last = 0;
  const ProgressFunction told = [&](const char* phase, std::size_t done, std::size_t total) {
    if (phases.empty() || phases.back() != phase) phases.emplace_back(phase);
    if (total > 0) {
      CHECK(done <= total);
      CHECK(done >= last);
      last = done;
    }
  };
  const Problem problem(rail, Monitor().telling(told));
  CHECK(phases == std::vector<std::string>{"Minkowski sum", "roadmap"});
  CHECK(last > 0);
}

TEST_CASE("OMPL from the command line: a planner, and a benchmark log") {
  const Folder folder;
  CHECK(planner(folder, scene("s7_one_box") + " --ompl rrtconnect --time 60").code == 0);
  const Run unsolved = planner(folder, scene("s1_narrower") + " --ompl RRTConnect --time 0.1");
  CHECK(unsolved.code == 4);
  CHECK_THAT(unsolved.out, Catch::Contains("this proves nothing"));
  CHECK_THAT(planner(folder, scene("s1_narrower") + " --ompl RRTConnect --time 0.1 --json").out,
             Catch::Contains("\"status\": \"undecided\""));
  CHECK(planner(folder, scene("s1_narrower") + " --ompl TightPlanner").code == 1);
  const std::string log = folder.file("bench.log");
  REQUIRE(
      planner(folder, scene("s1_tight_hole") + " --benchmark " + log + " --planners PRM --time 0.2 --runs 2").code ==
      0);
  const std::string text = text_of(log);
  CHECK(text.find("geometric_TightPlanner") != std::string::npos);
  CHECK(text.find("geometric_PRM") != std::string::npos);
  CHECK(text.find("thinnest piece INTEGER") != std::string::npos);
  const Run in_the_wall =
      planner(folder, scene("s1_tight_hole") + " --start 4,0,0 --benchmark " + folder.file("no.log"));
  CHECK(in_the_wall.code == 3);
  CHECK_THAT(in_the_wall.out, Catch::StartsWith("invalid_start: overlaps obstacle 1"));
  CHECK_FALSE(std::filesystem::exists(folder.file("no.log")));
}

TEST_CASE("numbers are the rationals that they spell") {
  const std::string text = R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(5,5,5, 6,6,6)"],
      "reference": [0.5, 0, 0], "start": [0.1, "1/3", 1e-3], "goal": [3, 0, 0]})J";
  const Scene scene = parse_scene(text, ".", "test");
  CHECK(*scene.start == Rational3{Rational(1, 10), Rational(1, 3), Rational(1, 1000)});
  CHECK((*bounding_box(scene.robot))[0] == Rational3{Rational(-1, 2), 0, 0});
}

TEST_CASE("the example program runs") {
  const Folder folder;
  const int status = std::system((program_folder() + "/planner_plan_from_ompl > " + folder.file("out")).c_str());
  CHECK(WEXITSTATUS(status) == 0);
  const std::string out = text_of(folder.file("out"));
  CHECK(out.find("TightPlanner: Exact solution, length 7.16667, checked yes") != std::string::npos);
  CHECK(out.find("TightPlanner: Infeasible\n") != std::string::npos);
  CHECK(out.find("No path: the free space has 2 components") != std::string::npos);
}

TEST_CASE("what OMPL's planners find is rounded by --digits") {
  const Folder folder;
  const std::string scene = source_folder() + "/data/planner/s7_one_box.json";
  const Run run = planner(folder, scene + " --ompl RRTConnect --time 20 --digits 2 --json");
  REQUIRE(run.code == 0);
  const nlohmann::json report = nlohmann::json::parse(run.out);
  CHECK(report["unrounded"] == nlohmann::json::array());
  for (const auto& point : report["path"]) {
    for (const auto& x : point) CHECK(Rational(rational_of(x, "x") * 100).get_den() == 1);
  }
  CHECK(planner(folder, source_folder() + "/data/planner/corner.json --ompl RRTConnect --digits 2").code == 2);
}

}  // namespace
}  // namespace nef::planner::test
