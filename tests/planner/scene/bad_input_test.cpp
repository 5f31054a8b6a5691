// SPDX-License-Identifier: Apache-2.0
//
// Every sort of bad input: one line on stderr that names what is wrong, nothing on stdout, exit code 2.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/planner/command_helpers.h"
#include "tests/support/paths.h"

namespace nef::planner::test {
namespace {

void check_refused(const Folder& folder, const std::string& arguments, const std::string& word) {
  INFO(arguments);
  const Run run = planner(folder, arguments);
  CHECK(run.code == 2);
  CHECK(run.out.empty());
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  CHECK_THAT(run.err, Catch::Contains(word));
}

// One word that is no number among the indices, on which assimp 5.2 takes memory for ever.
constexpr const char* kEndlessCollada = R"J(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 x 2</p></triangles>
</mesh></geometry></library_geometries></COLLADA>)J";

struct Bad {
  std::string text;
  std::string word;  // of the message
};

TEST_CASE("bad scenes") {
  const Folder folder;
  const std::string robot = R"J({"robot": "box(0,0,0, 1,1,1)", )J";
  const std::string ends = R"J("start": [0, 0, 5], "goal": [1, 1, 5]})J";
  const std::string free = R"J("obstacles": [], )J";
  const auto pose = [](const std::string& quaternion) {
    return R"J("start": {"position": [0, 0, 5], "quaternion": )J" + quaternion + "}";
  };
  const std::string turns = R"J(, "rotation": "SO(3)"})J";
  const std::vector<Bad> scenes{
      {"", "the file is empty"},
      {"no scene", "not a JSON file"},
      {"[1, 2]", "JSON object"},
      {R"J({"robot": )J", "not valid JSON"},
      {"{\n\"robot\": \"box(0,0,0, 1,1,1)\",\n oops}", "scene.json:3: not valid JSON near"},
      {R"J({"robot": ")J" + std::string(100000, 'x'), "not valid JSON near '...xxxx"},
      {R"J({"obstacles": []})J", "'robot' is missing"},
      {robot + ends, "'obstacles' is missing"},
      {robot + R"J("obstacle": []})J", "unknown key 'obstacle'"},
      {robot + R"J("robot": "box(0,0,0, 2,2,2)", )J" + free + ends, "'robot' is given twice"},
      {robot + R"J("name": 5, )J" + free + ends, "'name' must be a string"},
      {R"J({"robot": 5, )J" + free + ends, "robot: expected a file name or an expression"},
      {R"J({"robot": 3.5, )J" + free + ends, "not '3.5'"},
      {R"J({"robot": ["a.off", 0.5], )J" + free + ends, "not '[\"a.off\", 0.5]'"},
      {R"J({"robot": "", )J" + free + ends, "robot: '' is neither a file nor an expression"},
      {R"J({"robot": "cube", )J" + free + ends, "robot: 'cube' is neither a file nor an expression"},
      {R"J({"robot": "halfspace(0,0,1,0)", )J" + free + ends, "robot must be bounded"},
      {R"J({"robot": "box(0,0,0, 1,1,1) - box(0,0,0, 1,1,1)", )J" + free + ends, "robot is empty"},
      {robot + R"J("obstacles": "box(0,0,0, 1,1,1)", )J" + ends, "'obstacles' must be a list"},
      {robot + R"J("obstacles": [3], )J" + ends, "obstacle 0: expected a file name or an expression"},
      {robot + R"J("obstacles": ["no_such.off"], )J" + ends, "no_such.off: no such file"},
      {robot + R"J("obstacles": ["folder.off"], )J" + ends, "folder.off: is a folder"},
      {robot + R"J("obstacles": ["none.off"], )J" + ends, "none.off: the mesh has no faces"},
      {robot + R"J("obstacles": ["infinite.dae"], )J" + ends, "infinite.dae: a coordinate is not a finite number"},
      {robot + R"J("obstacles": ["box(0,0"], )J" + ends, "expression 'box(0,0'"},
      {robot + R"J("obstacles": ["halfspace(0,0,1,0)"], )J" + ends, "give the scene a box"},
      {robot + R"J("obstacles": ["bad.off"], )J" + ends, "face 0 names vertex 7"},
      {robot + R"J("obstacles": ["bad.dae"], )J" + ends, "bad.dae"},
#ifndef NEF_SANITIZED  // which leave memory without a bound
      {robot + R"J("obstacles": ["endless.dae"], )J" + ends, "endless.dae: assimp could not read the file within"},
#endif
      {robot + R"J("obstacles": ["bad.xyz"], )J" + ends, "bad.xyz"},
      {robot + free + R"J("box": [[1, 1, 1], [0, 0, 0]], )J" + ends, "box: its first point must be the lower one"},
      {robot + free + R"J("box": [[1, 1, 1]], )J" + ends, "'box' must be [low point, high point]"},
      {robot + free + R"J("contact": "maybe", )J" + ends, "contact: must be allow or forbid"},
      {robot + free + R"J("reference": [0, 0], )J" + ends, "reference: expected three numbers"},
      {robot + free + R"J("goal": [1, 1, 1]})J", "has no start"},
      {robot + free + R"J("start": [1, 1, 1]})J", "has no goal"},
      {robot + free + R"J("start": [0, 0], "goal": [1, 1, 1]})J", "start: expected three numbers"},
      {robot + free + R"J("start": [0, 0, 0, 90], "goal": [1, 1, 1]})J", "a fourth one, degrees, needs a 'rotation'"},
      {robot + free + R"J("start": "0,0,0", "goal": [1, 1, 1]})J", "start: expected three numbers"},
      {robot + free + R"J("start": [0, 0, "x"], "goal": [1, 1, 1]})J", "'x' is not a number"},
      {robot + free + R"J("start": [0, 0, "1/0"], "goal": [1, 1, 1]})J", "'1/0' is not a number"},
      {robot + free + R"J("start": [0, 0, NaN], "goal": [1, 1, 1]})J", "not valid JSON"},
      {robot + free + R"J("start": [0, 0, 1e999], "goal": [1, 1, 1]})J", "the number 1e999 is too large for JSON"},
      {robot + free + R"J("start": [0, 0, {"$number": 5}], "goal": [1, 1, 1]})J", "unknown key '$number'"},
      {robot + free + R"J("start": [0, 0, null], "goal": [1, 1, 1]})J", "start: expected a number"},
      {robot + free + R"J("rotation": "SO(2)"})J", "all rotations, or a range"},
      {robot + free + R"J("rotation": "SO(3)", )J" + ends, "since the robot turns freely"},
      {robot + free + pose("[1, 0, 0, 0]") + "}", "a pose with a quaternion needs"},
      {robot + free + pose("[0, 0, 0, 0]") + turns, "must not be zero"},
      {robot + free + pose("[0, 0, 1]") + turns, "a list of 4"},
      {robot + free + R"J("goal": {"position": [0, 0, 5]})J" + turns, "quaternion"},
  };
  static_cast<void>(folder.write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"));
  static_cast<void>(folder.write("bad.dae", "<COLLADA>"));
  static_cast<void>(folder.write("bad.xyz", "1 2 3"));
  static_cast<void>(folder.write("none.off", "OFF\n0 0 0\n"));
  std::string collada = text_of(source_folder() + "/data/planner/omplapp/cube.dae");
  const std::string first = "count=\"24\">0";
  collada.replace(collada.find(first), first.size(), "count=\"24\">1e99");
  static_cast<void>(folder.write("infinite.dae", collada));
  static_cast<void>(folder.write("endless.dae", kEndlessCollada));
  std::filesystem::create_directory(folder.file("folder.off"));
  for (const Bad& bad : scenes) check_refused(folder, folder.write("scene.json", bad.text), bad.word);
  check_refused(folder, folder.file("missing.json"), "no such file");
  check_refused(folder, folder.file(""), "is a directory");
}

TEST_CASE("bad .cfg files") {
  const Folder folder;
  const std::string cube = source_folder() + "/data/planner/omplapp/cube.dae";
  const std::string meshes = "[problem]\nrobot = " + cube + "\nworld = " + cube + "\n";
  const std::string start = "start.x = 3\nstart.y = 3\nstart.z = 3\n";
  const std::string goal = "goal.x = 4\ngoal.y = 3\ngoal.z = 3\n";
  const std::string turned = "start.theta = 1\ngoal.theta = 1\n";
  std::string upside_down;
  for (const std::string axis : {"x", "y", "z"}) {
    upside_down += "volume.min." + axis + " = 5\nvolume.max." + axis + " = 1\n";
  }
  const std::vector<Bad> problems{
      {"", "the file is empty"},
      {"[benchmark]\n", "has no [problem] section"},
      {"[problem]\nrobot\n", "expected key = value"},
      {"[problem]\nworld = " + cube + "\n", "has no key 'robot'"},
      {"[problem]\nrobot = none.dae\nworld = none.dae\n", "none.dae: no such file"},
      {meshes + start, "has no key 'goal.x'"},
      {meshes + goal + "start.x = far\nstart.y = 0\nstart.z = 0\n", "'far' is not a number"},
      {meshes + start + goal + upside_down, "volume.min is above volume.max"},
      {meshes + "start.x = 1\nstart.y = 1\n" + goal, "problem.cfg: [problem] has no key 'start.z'"},
      {meshes + start + goal + "volume.max.z = 1\n", "has no key 'volume.min.x'"},
      {meshes + start + goal + turned, "start.axis is the zero vector"},
      {meshes + start + goal + turned + "start.axis.x = 1\n", "goal.axis is the zero vector"},
      {meshes + start + goal + "start.theta = 1\n", "start.axis is the zero vector"},
      {meshes + start + goal + "contact = perhaps\n", "contact must be allow or forbid"},
      {meshes + start + goal + "robot.origin = corner\n", "robot.origin must be"},
  };
  for (const Bad& bad : problems) check_refused(folder, folder.write("problem.cfg", bad.text), bad.word);
}

TEST_CASE("bad usage") {
  const Folder folder;
  const std::string good = scene("s1_tight_hole") + " ";
  const std::string words = folder.write("words.txt", "hello world\n");
  const std::string two = folder.write("two.txt", "1 2\n");
  const std::string empty = folder.write("empty.txt", "");
  const std::string object = folder.write("object.json", "{}");
  for (const Bad& bad : std::vector<Bad>{
           {"", "scene is required"},
           {"--no-such-option " + good, "no-such-option"},
           {good + "another.json", "another.json"},
           {good + "--start 1,2", "--start: expected x,y,z instead of '1,2'"},
           {good + "--goal a,b,c", "--goal"},
           {good + "--contact maybe", "--contact"},
           {good + "--prefer fast", "--prefer"},
           {good + "--min-dimension 7", "--min-dimension"},
           {good + "--threads many", "--threads"},
           {good + "--time -1", "--time"},
           {good + "--runs 0", "--runs"},
           {good + "--ompl Dijkstra", "unknown OMPL planner 'Dijkstra'"},
           {good + "--benchmark x.log --planners PRM,Dijkstra", "unknown OMPL planner 'Dijkstra'"},
           {good + "--benchmark x.log --ompl PRM", "--benchmark excludes --ompl"},
           {good + "--benchmark /no/such/folder/x.log --planners RRT --time 0.05 --runs 1", "cannot be written"},
           {good + "--path " + words + " --ompl PRM", "--path excludes --ompl"},
           {good + "--range " + object, "--range excludes a scene"},
           {"--range " + good, "this is a scene of a robot among obstacles, for planner FILE"},
           {"--assembly " + good, "this is a scene of a robot among obstacles, for planner FILE"},
           {folder.write("parts.json", R"({"parts": {}})"), "this is an assembly, for planner --assembly FILE"},
           {folder.write("door.json", R"({"moving": "", "fixed": []})"),
            "this is a mechanism, for planner --range FILE"},
           {good + "--queries " + words + " -o x.path", "with --queries the extension must be .json"},
           {scene("corner") + " --quick", "a scene with a rotation excludes --quick"},
           {scene("corner") + " -o x.path", "the extension must be .json, .txt, .csv, .glb or .html"},
           {good + "--path missing.txt", "missing.txt: no such file"},
           {good + "--path " + words, "words.txt:1: 'hello' in 'hello world' is not a number"},
           {good + "--path " + two, "two.txt:1: expected x y z, or x y z qx qy qz qw, not 2 numbers"},
           {good + "--path " + folder.write("timed.csv", "t,x,y,z\n0,1,1,1\n"),
            "timed.csv: this is a table with times"},
           {good + "--path " + empty, "the file is empty"},
           {good + "--path " + object, "has no list 'path'"},
           {good + "--page view.png", "must be .html"},
           {good + "-o /no/such/folder/path.json", "cannot be written"},
           {good + "-o /no/such/folder/view.glb", "cannot be written"},
       }) {
    check_refused(folder, bad.text, bad.word);
  }
}

}  // namespace
}  // namespace nef::planner::test
