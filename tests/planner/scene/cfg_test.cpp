// SPDX-License-Identifier: Apache-2.0
//
// Problems and meshes as OMPL.app has them: .cfg files, COLLADA through assimp.
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/planner/scene/shapes.h"
#include "apps/planner/turning/turning_search.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/paths.h"

namespace nef::planner::test {
namespace {

std::string problem(const std::string& name) { return source_folder() + "/data/planner/omplapp/" + name; }

TEST_CASE("a problem with COLLADA meshes: turned upright, double faces once, the robot re-centred") {
  const Scene scene = read_scene(problem("wall.cfg"));
  const Rational half(1, 2);
  CHECK(equal(scene.robot, make_box({-half, -half, -half}, {half, half, half})));
  // (x, y, z) has become (x, z, -y).
  const Polyhedron hole = interior(make_box({3, 1, -2}, {6, 2, -1}));
  CHECK(equal(scene.obstacles.at(0), subtract(make_box({4, -9, -9}, {5, 9, 9}), hole)));
  const Problem solved(scene);
  const Answer answer = solved.solve();
  REQUIRE(answer.status == Answer::Status::kPath);
  CHECK(answer.thinness->piece == 1);
  CHECK(answer.path->points[1] == Rational3{Rational(7, 2), Rational(3, 2), Rational(-3, 2)});
  CHECK(independent_complaint(scene, solved.free_space().set(), *answer.path, true) == "");
}

TEST_CASE("one rotation for start and goal turns the robot once, two let it turn") {
  const Scene turned = read_scene(problem("wall_turned.cfg"));
  CHECK(volume(turned.robot) == Rational(1));
  CHECK(nearest_double((*bounding_box(turned.robot))[1][0]) == Approx((std::cos(0.3) + std::sin(0.3)) / 2));
  REQUIRE(turned.messages.size() == 2);
  CHECK_THAT(turned.messages[1], Catch::Contains("keeps its orientation"));
  CHECK(Problem(turned).solve().status == Answer::Status::kInfeasible);
  const Folder folder;
  // Turned upright the robot would fit: the answer says what it is about.
  const Run no = planner(folder, problem("wall_turned.cfg"));
  CHECK(no.code == 1);
  CHECK_THAT(no.out, Catch::StartsWith("infeasible by translation at this orientation: start is in component "));
  CHECK_THAT(no.err, Catch::Contains("planner: note: ") && Catch::Contains("OMPL.app's robots turn freely"));
  const Run no_report = planner(folder, problem("wall_turned.cfg") + " --json");
  CHECK(nlohmann::json::parse(no_report.out)["motions"] == "translation");
  CHECK_THAT(no_report.err, Catch::Contains("OMPL.app's robots turn freely"));
  CHECK(planner(folder, problem("wall_turned.cfg") + " --json --quiet").err.empty());
  // Free to turn, it comes upright first and passes the hole, which is as wide as the robot.
  const Run free = planner(folder, problem("wall_turned.cfg") + " --turn-freely --json");
  CHECK(free.code == 0);
  const nlohmann::json way = nlohmann::json::parse(free.out);
  CHECK(way["motions"] == "rigid");
  CHECK(way["path"].size() > 3);
  CHECK(free.err.find("OMPL.app's robots turn freely") == std::string::npos);
  const Run refused = planner(folder, scene("corner") + " --turn-freely");
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Catch::Contains("only the robots of .cfg files are made to turn freely"));
  const Run run = planner(folder, problem("wall_rotating.cfg") + " --json");
  CHECK(run.code == 0);
  const nlohmann::json report = nlohmann::json::parse(run.out);
  CHECK(report["path"].back()["turn"]["degrees"].get<double>() == Approx(1.5 * 180 / M_PI));
  CHECK(report["axis"] == "z");
  CHECK(report["motions"] == "translation and turning");
  CHECK(planner(folder, problem("wall.cfg") + " --json").code == 0);
}

TEST_CASE("rotations are equal if they turn alike, however their axes are written") {
  const Folder folder;
  const std::string meshes = "\xEF\xBB\xBF[problem]\nrobot = " + problem("cube.dae") +
                             "\nworld = " + problem("wall.dae") +
                             "\nstart.x = 2\nstart.y = 1.5\nstart.z = -1.5\ngoal.x = 7\ngoal.y = 1.5\ngoal.z = -1.5\n";
  const auto turn = [](const std::string& state, const std::string& theta, const std::string& z) {
    return state + ".theta = " + theta + "\n" + state + ".axis.z = " + z + "\n";
  };
  const std::string quarter = "1.5707963267948966";
  const std::string start = turn("start", quarter, "1");
  for (const std::string& goal :
       {turn("goal", quarter, "1"), turn("goal", quarter, "0.25"), turn("goal", "-" + quarter, "-3")}) {
    // A quarter turn leaves the cube as it is.
    const Scene scene = read_scene(folder.write("same.cfg", meshes + start + goal));
    CHECK(equal(scene.robot, read_scene(problem("wall.cfg")).robot));
    CHECK(Problem(scene).solve().status == Answer::Status::kPath);
  }
  for (const std::string& goal : {turn("goal", quarter, "-1"), turn("goal", "0.5", "1")}) {
    CHECK(read_scene(folder.write("other.cfg", meshes + start + goal)).rotation.has_value());
  }
  const std::string tilted = turn("goal", quarter, "1") + "goal.axis.x = 1\n";
  CHECK(read_scene(folder.write("other.cfg", meshes + start + tilted)).turns_freely);
}

TEST_CASE("scenes name COLLADA meshes too") {
  const std::string text = R"J({"robot": "cube.dae", "obstacles": ["wall.dae"], "reference": [0.5, 0.5, -0.5]})J";
  const Scene scene = parse_scene(text, problem(""), "test");
  const Scene app = read_scene(problem("wall.cfg"));
  CHECK(equal(scene.robot, app.robot));
  CHECK(equal(scene.obstacles.at(0), app.obstacles.at(0)));
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
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  // Different angles: the robot turns, about one axis.
  const Scene turns = read_scene(folder.write("c.cfg", head + turned("start") + goal));
  REQUIRE(turns.rotation.has_value());
  CHECK(turns.rotation->axis == Rational3{1, 0, 0});
  CHECK(nearest_double(turns.rotation->start) == Approx(1.5 * 180 / M_PI));
  CHECK(turns.rotation->goal == 0);
  CHECK((*bounding_box(turns.robot))[0] == Rational3{-half, -half, -half});
  const Scene other_way = read_scene(folder.write(
      "o.cfg", head + turned("start") + replaced(turned("goal"), "goal.axis.x=1", "goal.axis.x=-2") + bounds));
  REQUIRE(other_way.rotation.has_value());
  CHECK(nearest_double(other_way.rotation->goal) == Approx(-1.5 * 180 / M_PI));
  CHECK(question_of(other_way).goal.turn > 0);  // taken into the full circle
  const std::string two_axes = folder.write("w.cfg", head + turned("start") + turned("goal") + "goal.axis.y=1\n");
  // About different axes: the robot turns freely.
  const Scene free = read_scene(two_axes);
  CHECK(free.turns_freely);
  CHECK_THROWS_WITH(Problem(free), Catch::Contains("different axes"));
  CHECK_THROWS_AS(question_of(free), InputError);
  REQUIRE(free.quaternions.has_value());
  const auto& [at_start, at_goal] = *free.quaternions;
  CHECK(nearest_double(at_start[0]) == Approx(std::cos(0.75)));
  CHECK(nearest_double(at_start[1]) == Approx(std::sin(0.75)));
  CHECK(nearest_double(at_goal[2]) == Approx(std::sin(0.75) / std::sqrt(2)));
  const std::string turning = folder.write("turning.path", "-3 0.5 0.5 1 0 0 1\n3 0.5 0.5 1 0 1 1\n");
  CHECK(planner(folder, two_axes + " --path " + turning).code == 1);  // through the obstacle
  CHECK(planner(folder, two_axes + " --quiet").code == 0);
  CHECK_THROWS_AS(read_scene(folder.write("z.cfg", head + start + replaced(turned("goal"), "axis.x=1", "axis.x=0"))),
                  InputError);
  const Scene rotated = read_scene(folder.write("d.cfg", head + turned("start") + turned("goal")));
  CHECK(nearest_double((*bounding_box(rotated.robot))[1][1]) == Approx((std::cos(1.5) + std::sin(1.5)) / 2));
  CHECK(volume(rotated.robot) == Rational(1));
  CHECK_THROWS_AS(read_scene(folder.write("e.cfg", "[problem]\nrobot=cube.off\n")), InputError);
}

TEST_CASE("meshes come in through assimp, double faces are kept once") {
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

// A word that is no number made assimp run and grow for ever.
TEST_CASE("a COLLADA file that assimp never finishes is refused in one line") {
  const Folder folder;
  const std::string cube = read_file(problem("cube.dae"));
  const std::string face = "<p>0 1 3 ";
  std::string bad = cube;
  const std::size_t at = bad.find(face);
  REQUIRE(at != std::string::npos);
  bad.replace(at, face.size(), "<p>0 x 3 ");
  try {
    read_with_assimp(folder.write("bad.dae", bad), nullptr);
    FAIL("read");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find("bad.dae: ") != std::string::npos);
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
  }
}

}  // namespace
}  // namespace nef::planner::test
