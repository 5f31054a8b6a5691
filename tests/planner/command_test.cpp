// SPDX-License-Identifier: Apache-2.0
//
// The command `planner` as users call it, the readers of scenes, and the example program.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/planner/shapes.h"
#include "nef/base/error.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace fs = std::filesystem;

// A folder of its own that goes away with the test.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("planner_test_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name);
  }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator{}));
  }

 private:
  fs::path path_;
};

std::string text_of(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct Run {
  int code;
  std::string out;
  std::string err;
};

Run planner(const Folder& folder, const std::string& arguments) {
  const std::string command =
      std::string(PLANNER_COMMAND) + " " + arguments + " > " + folder.file("out") + " 2> " + folder.file("err");
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), text_of(folder.file("out")), text_of(folder.file("err"))};
}

std::string scene(const std::string& name) { return std::string(PLANNER_SCENES) + "/" + name + ".json"; }

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
  CHECK(report["phases"].contains("configuration_space"));

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

TEST_CASE("bad usage and bad input: one line, exit code 2") {
  const Folder folder;
  const std::string robot = R"J({"robot": "box(0,0,0, 1,1,1)", )J";
  const std::string ends = R"J("start": [0, 0, 5], "goal": [1, 1, 5]})J";
  const std::vector<std::string> arguments{
      "missing.json",
      folder.write("a.json", R"J({"robot": )J"),
      folder.write("b.json", R"J({"obstacles": []})J"),
      folder.write("c.json", robot + R"J("obstacles": [], "start": [0, 0], "goal": [1, 1, 1]})J"),
      folder.write("d.json", robot + R"J("obstacles": [], "start": [0, 0, "x"], "goal": [1, 1, 1]})J"),
      folder.write("e.json", robot + R"J("obstacles": ["no_such.off"], )J" + ends),
      folder.write("f.json", robot + R"J("obstacles": ["box(0,0"], )J" + ends),
      folder.write("g.json", robot + R"J("obstacles": [], "goal": [1, 1, 1]})J"),
      folder.write("h.json", robot + R"J("obstacles": ["halfspace(0,0,1,0)"], )J" + ends),
      folder.write("i.json", robot + R"J("obstacle": []})J"),
      scene("s1_tight_hole") + " -o /no/such/folder/path.json",
      scene("s1_tight_hole") + " --ompl Dijkstra",
  };
  for (const std::string& a : arguments) {
    INFO(a);
    const Run run = planner(folder, a);
    CHECK(run.code == 2);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
  CHECK(planner(folder, "--no-such-option").code == 2);
  CHECK(planner(folder, "").code == 2);
  CHECK(planner(folder, "--help").code == 0);
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
  const Run tight = planner(folder, "--tight " + scene("s2_tight_slot"));
  CHECK(tight.code == 0);
  CHECK(tight.out.find("passage 0: dimension 2") == 0);
  CHECK(planner(folder, scene("s1_tight_hole") + " --quiet").out.empty());
}

TEST_CASE("OMPL from the command line: a planner, and a benchmark log") {
  const Folder folder;
  CHECK(planner(folder, scene("s7_one_box") + " --ompl rrtconnect --time 5").code == 0);
  CHECK(planner(folder, scene("s1_narrower") + " --ompl RRTConnect --time 0.1").code == 4);
  CHECK(planner(folder, scene("s1_narrower") + " --ompl TightPlanner").code == 1);
  const std::string log = folder.file("bench.log");
  REQUIRE(
      planner(folder, scene("s1_tight_hole") + " --benchmark " + log + " --planners PRM --time 0.2 --runs 2").code ==
      0);
  const std::string text = text_of(log);
  CHECK(text.find("geometric_TightPlanner") != std::string::npos);
  CHECK(text.find("geometric_PRM") != std::string::npos);
  CHECK(text.find("thinnest piece INTEGER") != std::string::npos);
}

TEST_CASE("numbers are the rationals that they spell") {
  const std::string text = R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(5,5,5, 6,6,6)"],
      "reference": [0.5, 0, 0], "start": [0.1, "1/3", 1e-3], "goal": [3, 0, 0]})J";
  const Scene scene = parse_scene(text, ".", "test");
  CHECK(*scene.start == Rational3{Rational(1, 10), Rational(1, 3), Rational(1, 1000)});
  CHECK((*bounding_box(scene.robot))[0] == Rational3{Rational(-1, 2), 0, 0});
}

TEST_CASE("OMPL.app's .cfg with meshes: re-centred and turned once") {
  const Folder folder;
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
  const std::string faces = "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  static_cast<void>(folder.write("cube.off", "OFF\n8 6 0\n" + vertices + faces));
  const std::string head = "[problem]\nname = test # a comment\nrobot = cube.off\nworld=cube.off\n";
  const std::string start = "start.x=-3\nstart.y=0\nstart.z=0\nstart.theta=0\nstart.axis.x=1\n";
  const std::string goal = "goal.x=3\ngoal.y=1/3\ngoal.z=0.1\ngoal.theta=0\ngoal.axis.x=1\n";
  std::string bounds;
  for (const char* axis : {"x", "y", "z"}) {
    bounds += std::string("volume.min.") + axis + "=-4\nvolume.max." + axis + "=4\n";
  }
  const Scene scene = read_scene(folder.write("a.cfg", head + start + goal + bounds + "[benchmark]\ntime_limit=20\n"));
  const Rational half(1, 2);
  CHECK((*bounding_box(scene.robot))[0] == Rational3{-half, -half, -half});
  CHECK((*bounding_box(scene.robot))[1] == Rational3{half, half, half});
  CHECK(*scene.goal == Rational3{3, Rational(1, 3), Rational(1, 10)});
  REQUIRE(scene.box.has_value());
  CHECK(Problem(scene).solve().status == Answer::Status::kPath);

  const Scene mesh = read_scene(folder.write("b.cfg", head + "robot.origin=mesh\n" + start + goal));
  CHECK((*bounding_box(mesh.robot))[0] == Rational3{0, 0, 0});
  const auto turned = [](const std::string& what) {
    return what + ".x=-3\n" + what + ".y=0\n" + what + ".z=0\n" + what + ".theta=1.5\n" + what + ".axis.x=1\n";
  };
  CHECK_THROWS_AS(read_scene(folder.write("c.cfg", head + turned("start") + goal)), InputError);
  const Scene rotated = read_scene(folder.write("d.cfg", head + turned("start") + turned("goal")));
  CHECK(nearest_double((*bounding_box(rotated.robot))[1][1]) == Approx((std::cos(1.5) + std::sin(1.5)) / 2));
  CHECK(volume(rotated.robot) == Rational(1));
  CHECK_THROWS_AS(read_scene(folder.write("e.cfg", "[problem]\nrobot=cube.off\n")), InputError);
}

TEST_CASE("meshes come in through assimp; double faces are kept once") {
  const Folder folder;
  std::string text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  text += "element face 8\nproperty list uchar int vertex_indices\nend_header\n";
  text += "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  for (const char* face : {"0 2 1", "0 1 3", "0 3 2", "1 2 3"}) text += std::string("3 ") + face + "\n";
  for (const char* face : {"1 2 0", "3 1 0", "2 3 0", "3 2 1"}) text += std::string("3 ") + face + "\n";
  Rational3 mean;
  const Mesh mesh = read_with_assimp(folder.write("tetrahedron.ply", text), &mean);
  CHECK(mesh.vertices.size() == 4);
  CHECK(mesh.face_count() == 4);
  CHECK(volume(from_mesh(mesh)) == Rational(1, 6));
  CHECK_THROWS_AS(read_with_assimp(folder.write("bad.dae", "no mesh"), nullptr), InputError);
}

TEST_CASE("the example program runs") {
  const Folder folder;
  const int status = std::system((std::string(PLANNER_EXAMPLE) + " > " + folder.file("out")).c_str());
  CHECK(WEXITSTATUS(status) == 0);
  const std::string out = text_of(folder.file("out"));
  CHECK(out.find("TightPlanner: Exact solution, length 7.16667, checked yes") != std::string::npos);
  CHECK(out.find("No path: the free space has 2 components") != std::string::npos);
}

}  // namespace
}  // namespace nef::planner::test
