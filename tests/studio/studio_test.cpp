// SPDX-License-Identifier: Apache-2.0
//
// What pages ask, without a server in between.
#include "apps/studio/studio.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>

#include "apps/studio/run_state.h"
#include "nef/construct/construct.h"
#include "nef/construct/round_shapes.h"
#include "nef/io/file_bytes.h"
#include "nef/io/polyhedron_file.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

namespace nef::studio {
namespace {

namespace fs = std::filesystem;

class Place : public nef::test::TemporaryFolder {
 public:
  Place() : root(fs::path(path()) / "root") {
    fs::create_directories(root);
    write_polyhedron((root / "cube.off").string(), make_box({0, 0, 0}, {1, 1, 1}));
    write_polyhedron((fs::path(path()) / "outside.off").string(), make_box({0, 0, 0}, {1, 1, 1}));
    fs::create_symlink("../outside.off", root / "link.off");
  }
  fs::path root;
};

Json answer(Studio& studio, const std::string& name, Json request, int status = 200) {
  if (request.is_null()) request = Json::object();
  request.emplace("page", "a");
  const WebReply reply = studio.answer({"POST", "/api/" + name, request.dump()});
  INFO(reply.body.substr(0, 300));
  CHECK(reply.status == status);
  return Json::parse(reply.body, nullptr, false);
}

// The report of a computation, and the scene's JSON.
struct Computed {
  Json report;
  Json scene;
  std::size_t bytes = 0;
};
std::size_t length_at(const std::string& bytes, std::size_t at) {
  std::size_t length = 0;
  for (unsigned i = 0; i < 4; ++i)
    length |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + i])) << 8 * i;
  return length;
}
Computed compute(Studio& studio, const Json& request) {
  const WebReply reply = studio.answer({"POST", "/api/compute", request.dump()});
  INFO(reply.body.substr(0, 300));
  REQUIRE(reply.status == 200);
  const std::size_t report = length_at(reply.body, 0);
  const std::size_t scene = length_at(reply.body, 8 + report);
  return {Json::parse(reply.body.substr(8, report)), Json::parse(reply.body.substr(12 + report, scene)),
          reply.body.size()};
}

TEST_CASE("Sets: an expression gives measures, a scene and files") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  const Computed computed =
      compute(studio, {{"page", "a"}, {"panel", "sets"}, {"text", "file(\"cube.off\") + box(2,0,0, 3,1,1/2)"}});
  CHECK(computed.report["result"]["volume"] == "3/2");
  CHECK(computed.scene["layers"].size() == 1);
  CHECK(computed.scene["layers"][0]["facets"]["begin"][2] == 13);
  const Json written = answer(studio, "export", {{"set", "result"}, {"name", "out.off"}});
  CHECK(written["bytes"] == fs::file_size(place.root / "out.off"));
  CHECK(equal(read_polyhedron((place.root / "out.off").string()),
              unite(make_box({0, 0, 0}, {1, 1, 1}), make_box({2, 0, 0}, {3, 1, Rational(1, 2)}))));
  answer(studio, "export", {{"set", "result"}, {"name", "out.off"}}, 422);
  answer(studio, "export", {{"set", "result"}, {"name", "out.off"}, {"overwrite", true}});
  answer(studio, "export", {{"set", "result"}, {"name", "../out.off"}}, 422);
  answer(studio, "export", {{"set", "none"}, {"name", "new.off"}}, 422);
  answer(studio, "export", {{"set", "result"}, {"name", "new.exe"}}, 422);
  CHECK(!fs::exists(place.root / "new.exe"));
}

TEST_CASE("Sets: a large one is changed in tiles, of which a page gets those that have changed") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  const auto text = [](int i) {
    return "s = sphere(10, 100); s - translate(box(-1,-1,-1, 1,1,1), 10,0," + std::to_string(i) + "/10)";
  };
  Json request{{"page", "a"}, {"panel", "sets"}, {"text", text(0)}, {"has", Json::array()}};
  const Computed first = compute(studio, request);
  const Json pieces = first.report["pieces"];
  REQUIRE(pieces.size() > 10);
  for (const Json& piece : pieces) {
    CHECK(piece[1].get<std::size_t>() > 0);
    request["has"].push_back(piece[0]);
  }
  for (int i = 1; i < 4; ++i) {
    request["text"] = text(i);
    const Computed next = compute(studio, request);
    std::size_t sent = 0;
    for (const Json& piece : next.report["pieces"]) sent += piece[1] == 0 ? 0 : 1;
    CHECK(sent > 0);
    CHECK(3 * sent < pieces.size());
    CHECK(3 * next.bytes < first.bytes);
    // Without tiles.
    const Polyhedron whole =
        subtract(make_sphere(10, 100), make_box({9, -1, Rational(i, 10) - 1}, {11, 1, Rational(i, 10) + 1}));
    const Json measures = next.report["result"];
    const double exact = nearest_double(*volume(whole));
    CHECK(std::fabs(measures["volume_double"].get<double>() - exact) <= measures["volume_error"].get<double>() + 1e-12);
    if (i < 3) continue;
    answer(studio, "export", {{"set", "result"}, {"name", "tiles.nef"}});
    CHECK(equal(read_polyhedron((place.root / "tiles.nef").string()), whole));
  }
  // What would be unbounded is not in tiles.
  request["text"] = "sphere(10, 100) + halfspace(0,0,1,20)";
  CHECK(compute(studio, request).report["pieces"].empty());
}

TEST_CASE("Details of an item of the last scene") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  const Json request{{"page", "a"}, {"panel", "sets"}, {"text", "interior(box(0,0,0, 1,1,1/3))"}};
  const Json scene = compute(studio, request).report["scene"];
  const Json vertex = answer(studio, "item", {{"scene", scene}, {"layer", 0}, {"vertices", {7}}});
  CHECK(vertex["points"] == Json::array({"1 1 1/3"}));
  CHECK(vertex["spheres"]["begin"] == Json({0, 0, 0, 0, 3, 3, 0, 2}));
  CHECK(vertex["spheres"]["dots"].size() == 6);
  const Json facet = answer(studio, "item", {{"scene", scene}, {"layer", 0}, {"facet", 0}});
  CHECK(facet["plane"].get<std::string>().find(' ') != std::string::npos);
  CHECK(answer(studio, "item", {{"scene", scene}, {"layer", 0}, {"vertices", {0, 1}}})["points"].size() == 2);
  answer(studio, "item", {{"scene", scene}, {"layer", 0}, {"vertices", {8}}}, 422);
  answer(studio, "item", {{"scene", scene}, {"layer", 0}, {"facet", 6}}, 422);
  answer(studio, "item", {{"scene", scene}, {"layer", 1}, {"facet", 0}}, 422);
  answer(studio, "item", {{"scene", 77}, {"layer", 0}, {"facet", 0}}, 422);
  answer(studio, "item", {{"layer", 0}, {"facet", 0}}, 422);
  answer(studio, "item", {{"scene", scene}, {"layer", 0}, {"vertices", {0, 1, 2}}}, 422);
}

TEST_CASE("Sets: what is wrong has its place") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  Json error = answer(studio, "compute", {{"panel", "sets"}, {"text", "box(0,0,0, 1,1,1) + bx"}}, 422);
  CHECK(error["field"] == "text");
  CHECK(error["offset"] == 20);
  error = answer(studio, "compute", {{"panel", "sets"}, {"text", " "}}, 422);
  CHECK(error["offset"] == 0);
  for (const std::string file : {"../outside.off", "link.off", "/etc/passwd", "none.off"}) {
    error = answer(studio, "compute", {{"panel", "sets"}, {"text", "file(\"" + file + "\")"}}, 422);
    CHECK(error["error"].get<std::string>().find(file) != std::string::npos);
  }
  answer(studio, "compute", {{"panel", "none"}, {"text", "everything"}}, 422);
  answer(studio, "compute", {{"panel", "sets"}, {"page", "../x"}, {"text", "everything"}}, 422);
  CHECK(studio.answer({"POST", "/api/compute", "[1"}).status == 422);
  CHECK(studio.answer({"POST", "/api/compute", std::string(1000000, '[')}).status == 422);
  CHECK(studio.answer({"POST", "/api/none", "{}"}).status == 404);
  CHECK(studio.answer({"GET", "/etc/passwd", ""}).status == 404);
}

// apps/studio/panels/set_questions.cpp
TEST_CASE("Sets: an exact section, the distance of two shapes, shapes by colour") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  Json request{{"page", "a"},
               {"panel", "sets"},
               {"text", "box(0,0,0, 3,3,3) - box(1,1,1, 2,2,2) + box(2,2,2, 4,4,4)"},
               {"section", {{"axis", 2}, {"offset", "3/2"}}},
               {"from", "box(0,0,0, 1,1,1)"},
               {"to", "box(2,2,1, 3,3,3)"}};
  const Computed computed = compute(studio, request);
  const Json section = computed.report["section"];
  CHECK(section["polygons"] == 1);
  CHECK(section["area"] == 8);
  CHECK(section["svg"].get<std::string>().find("<path d=\"M") != std::string::npos);
  const Json distance = computed.report["distance"];
  CHECK(distance["contact"] == "disjoint");
  CHECK(distance["squared"] == "2");
  CHECK(distance["from"] == Json({"1", "1", "1"}));
  CHECK(distance["to"] == Json({"2", "2", "1"}));
  CHECK(computed.report["pieces"].size() == 2);
  answer(studio, "export", {{"set", "section"}, {"name", "section.nef"}});
  const Polyhedron plane =
      intersect(make_halfspace(0, 0, 1, Rational(-3, 2)), make_halfspace(0, 0, -1, Rational(3, 2)));
  CHECK(equal(read_polyhedron((place.root / "section.nef").string()),
              intersect(plane, subtract(make_box({0, 0, 0}, {3, 3, 3}), make_box({1, 1, 1}, {2, 2, 2})))));
  // Of a set in tiles, too.
  request["text"] = "sphere(10, 100) - box(0,-20,-20, 20,20,20)";
  request["section"] = {{"axis", 0}, {"offset", "-1"}};
  CHECK(compute(studio, request).report["section"]["polygons"] == 1);
  request["section"] = {{"axis", 0}, {"offset", "20"}};
  CHECK(compute(studio, request).report["section"]["polygons"] == 0);
  request["section"] = {{"axis", 3}, {"offset", "0"}};
  CHECK(compute(studio, request).report["question_error"]["field"] == "section");
  request["section"] = {{"axis", 1}, {"offset", "x"}};
  CHECK(compute(studio, request).report["question_error"]["field"] == "section");
  request["section"] = nullptr;
  request["to"] = "nothing";
  CHECK(compute(studio, request).report["question_error"]["field"] == "to");
  request["to"] = "box(";
  CHECK(compute(studio, request).report["question_error"]["field"] == "to");
  request["to"] = " ";
  CHECK(!compute(studio, request).report.contains("distance"));

  request["text"] = "box(0,0,0, 2,2,2) + box(1,1,1, 3,3,3)";
  request["shapes"] = true;
  std::vector<std::string> names;
  const Computed shapes = compute(studio, request);
  for (const Json& layer : shapes.scene["layers"]) names.push_back(layer["name"]);
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"shape 1", "shape 2", "shapes 1 and 2"});
  std::string many = "point(0,0,0)";
  for (int i = 1; i <= 12; ++i) many += " + point(" + std::to_string(i) + ",0,0)";
  request["text"] = many;
  const Computed too_many = compute(studio, request);
  CHECK(too_many.report["question_error"]["field"] == "shapes");
  CHECK(too_many.scene["layers"][0]["name"] == "result");
}

TEST_CASE("Sums: what a tool reaches") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  // A slot of width 1 in the middle of a cube, and a tool of side 2, or 1, which fits.
  Json request{{"page", "a"},
               {"panel", "sums"},
               {"a", "box(0,0,0, 5,5,5) - box(2,-1,3, 3,6,6)"},
               {"b", "box(0,0,0, 2,2,2)"},
               {"kind", "reach"}};
  Computed computed = compute(studio, request);
  CHECK(computed.report["untouched"].is_object());
  CHECK(computed.scene["layers"].size() == 4);
  request["b"] = "box(0,0,0, 1,1,1)";
  CHECK(compute(studio, request).report["untouched"].is_null());
  answer(studio, "export", {{"set", "touched"}, {"name", "touched.nef"}});
  request["from"] = "1,1";
  CHECK(answer(studio, "compute", request, 422)["field"] == "from");
  request["from"] = "1,1,1";  // in the part
  answer(studio, "compute", request, 422);
  request["from"] = "9, 1/2, 1";
  CHECK(compute(studio, request).report["untouched"].is_null());
}

TEST_CASE("Sums: sums, offsets between bounds, penetration") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  Json request{
      {"page", "a"},     {"panel", "sums"}, {"a", "box(0,0,0, 2,2,2)"}, {"b", "box(0,0,0, 1,1,1)"}, {"kind", "sum"},
      {"radius", "1/2"}, {"splits", 2}};
  CHECK(compute(studio, request).report["result"]["volume"] == "27");
  request["kind"] = "erosion";
  CHECK(compute(studio, request).report["result"]["volume"] == "1");
  request["kind"] = "opening";
  CHECK(compute(studio, request).report["result"]["volume"] == "8");
  request["kind"] = "closing";
  CHECK(compute(studio, request).report["result"]["volume"] == "8");
  request["kind"] = "offset";
  const Json offset = compute(studio, request).report;
  // The rounded cube: 8 + 6 * 4 / 2 + 12 * 2 * pi / 16 + 4 pi / 24.
  const double exact = 8 + 12 + 12 * 2 * 3.14159265358979 / 16 + 4 * 3.14159265358979 / 24;
  CHECK(offset["result"]["volume_double"].get<double>() < exact);
  CHECK(offset["outer"]["volume_double"].get<double>() > exact);
  CHECK(offset["error"].get<double>() > 0);
  request["kind"] = "penetration";
  const Json penetration = compute(studio, request).report;
  CHECK(penetration["kind"] == "overlapping");
  CHECK(penetration["squared_length"] == "1");
  request["kind"] = "offset";
  request["radius"] = "much";
  CHECK(answer(studio, "compute", request, 422)["field"] == "radius");
  request["radius"] = "1";
  request["splits"] = 1000;
  CHECK(answer(studio, "compute", request, 422)["field"] == "splits");
  request["kind"] = "sum";
  request["b"] = "box(";
  CHECK(answer(studio, "compute", request, 422)["field"] == "b");
}

TEST_CASE("Planner: a tight hole, the hole moved away, and files of the scene") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  const std::string scene = R"~({"robot": "file(\"cube.off\")",
    "obstacles": ["box(-1,-1,-1, 10,4,4) - interior(box(0,0,0, 9,3,3))", "box(4,0,0, 5,3,3) - box(4,1,1, 5,2,2)"],
    "start": [1, "1/2", "1/2"], "goal": [7, "3/2", "3/2"]})~";
  Json request{{"page", "a"}, {"panel", "planner"}, {"scene", scene}, {"folder", ""}, {"free", true}};
  Json report = compute(studio, request).report;
  CHECK(report["answer"]["status"] == "path");
  CHECK(report["answer"]["tight"].size() == 1);
  CHECK(report["start"] == Json({"1", "1/2", "1/2"}));
  // Pushed aside by a half, the wall leaves a gap of that width, and the hole is as it was; pushed by one, no less does
  // the robot fit through the gap than through the hole; pushed into the room's floor by a half, the hole is cut.
  request["moves"] = {{"1", {"0", "1/2", "0"}}};
  report = compute(studio, request).report;
  CHECK(report["answer"]["status"] == "path");
  CHECK(report["answer"]["tight"].size() == 1);
  request["moves"] = {{"1", {"0", "1", "0"}}};
  CHECK(compute(studio, request).report["answer"]["tight"].size() == 2);
  request["moves"] = {{"1", {"0", "0", "-1.5"}}};
  request["moves"]["1"][2] = "-1.5";
  CHECK(compute(studio, request).report["answer"]["status"] == "path");  // over the wall
  request.erase("moves");
  request["start"] = {"3.5", "0", "0"};
  CHECK(compute(studio, request).report["answer"]["status"] == "invalid_start");
  request["start"] = {"1", "x", "1"};
  CHECK(answer(studio, "compute", request, 422)["field"] == "start");
  request["start"] = nullptr;
  request["moves"] = {{"7", {"0", "0", "0"}}};
  answer(studio, "compute", request, 422);
  request.erase("moves");
  for (const std::string file : {"../outside.off", "link.off"}) {
    for (const std::string& shape : {file, "file(\"" + file + "\")"}) {
      request["scene"] = Json({{"robot", "box(0,0,0, 1,1,1)"}, {"obstacles", {shape}}}).dump();
      const Json error = answer(studio, "compute", request, 422);
      CHECK(error["error"].get<std::string>().find("below the folder") != std::string::npos);
    }
  }
  request["scene"] = R"~({"robot": "outside.off", "obstacles": ["box(5,5,5, 6,6,6)"]})~";
  request["folder"] = "..";
  CHECK(answer(studio, "compute", request, 422)["error"].get<std::string>().find("below the folder") !=
        std::string::npos);
}

TEST_CASE("Planner: obstacles that rest are kept, and files are read again when they have changed") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  Json obstacles = Json::array({"cube.off"});
  for (int i = 1; i < 70; ++i) {
    const std::string x = std::to_string(3 * i);
    obstacles.push_back("box(" + x + ",0,0, " + x + ".5,1,1)");
  }
  const Json scene{{"robot", "box(0,0,0, 1,1,1)"}, {"obstacles", obstacles}, {"start", {0, 5, 0}}, {"goal", {9, 5, 0}}};
  Json request{{"page", "a"}, {"panel", "planner"}, {"scene", scene.dump()}, {"folder", ""}, {"moves", Json::object()}};
  const auto facets_of = [](const Json& drawn, const std::string& name) {
    for (const Json& layer : drawn["layers"]) {
      if (layer["name"] == name) return layer["facets"]["index"][2].get<std::size_t>();
    }
    return std::size_t{0};
  };
  CHECK(compute(studio, request).report["pieces"].size() == 1);
  for (const char* y : {"5", "0", "-5"}) {
    request["moves"] = {{"7", {"0", y, "0"}}};
    const Computed moved = compute(studio, request);
    CHECK(facets_of(moved.scene, "obstacles") == 0);  // a piece
    REQUIRE(moved.report["pieces"].size() == 1);
    CHECK(moved.report["pieces"][0][0].get<int>() > 0);
    CHECK((moved.report["pieces"][0][1] == 0) == (request["has"] == Json::array({moved.report["pieces"][0][0]})));
    request["has"] = Json::array({moved.report["pieces"][0][0]});
    CHECK(facets_of(moved.scene, "obstacle 7") == 6);
    CHECK(moved.report["answer"]["status"] == "path");
  }
  request["moves"] = {{"7", {"-21", "5", "0"}}};
  CHECK(compute(studio, request).report["answer"]["status"] == "invalid_start");
  request["moves"] = Json::object();
  CHECK(compute(studio, request).report["answer"]["status"] == "path");
  write_polyhedron((place.root / "cube.off").string(), make_box({0, 0, 0}, {1, 6, 1}));
  fs::last_write_time(place.root / "cube.off", fs::file_time_type::clock::now() + std::chrono::seconds(5));
  CHECK(compute(studio, request).report["answer"]["status"] == "invalid_start");
}

// apps/studio/panels/planner/turning_answers.cpp
TEST_CASE("Planner: robots that turn") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  const auto scene = [](const std::string& rest) {
    return R"~({"robot": "box(-1,-1/4,-1/4, 1,1/4,1/4)", "obstacles": ["box(2,-5,-5, 3,5,5)"], )~" + rest + "}";
  };
  Json request{{"page", "a"}, {"panel", "planner"}, {"folder", ""}};
  request["scene"] = scene(R"~("box": [[-4,-4,-4], [4,4,4]], "rotation": {"axis": "z", "range": [0, 90]},
    "start": [0, 0, 0, 0], "goal": [0, 0, 0, 90])~");
  Computed computed = compute(studio, request);
  CHECK(computed.report["answer"]["status"] == "path");
  CHECK(computed.report["answer"]["motions"] == "translation and turning");
  CHECK(computed.report["goal"] == Json({"0", "0", "0", "90"}));
  CHECK(computed.scene["layers"][0]["motion"]["turns"].size() > 1);
  request["goal"] = {"3/2", "0", "0", "0"};  // in the wall
  CHECK(compute(studio, request).report["answer"]["status"] == "invalid_goal");
  request["goal"] = {"3/2", "0", "0", "90"};  // beside it
  request["dragged"] = true;
  CHECK(compute(studio, request).report["answer"]["status"] == "path");
  request["goal"] = {"1", "0"};
  CHECK(answer(studio, "compute", request, 422)["field"] == "goal");
  request["goal"] = nullptr;
  request["dragged"] = false;
  request["ompl"] = "RRTConnect";
  request["seconds"] = 60;  // much more than it needs
  const auto check_ompl = [&] {
    CHECK(computed.report["ompl"]["name"] == "RRTConnect");
    CHECK(computed.report["ompl"]["status"] == "path");
    CHECK(computed.report["ompl"]["waypoints"].get<int>() > 1);
    CHECK(computed.scene["layers"].back()["name"] == "path of RRTConnect");
  };
  computed = compute(studio, request);
  check_ompl();
  request["scene"] = scene(R"~("box": [[-4,-4,-4], [4,4,4]], "rotation": "SO(3)",
    "start": {"position": [0, 0, 0], "quaternion": [1, 0, 0, 0]}, "goal": {"position": [0, 1, 0], "quaternion": [1, 0, 0, 1]})~");
  computed = compute(studio, request);
  CHECK(computed.report["answer"]["status"] == "path");
  CHECK(computed.report["answer"]["motions"] == "rigid");
  CHECK(computed.report["goal"] == Json({"0", "1", "0", "1", "0", "0", "1"}));
  check_ompl();
  request["moves"] = {{"0", {"-2", "0", "0"}}};
  CHECK(compute(studio, request).report["answer"]["status"] == "invalid_start");
}

TEST_CASE("Planner: a .cfg scene of OMPL.app, and a planner of OMPL beside ours") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  const auto cfg = [](const std::string& robot) {
    return "[problem]\nrobot = " + robot + "\nrobot.origin = mesh\nworld = cube.off\nstart.x = 3\nstart.y = 0\n" +
           "start.z = 0\ngoal.x = -3\ngoal.y = 0\ngoal.z = 0\nvolume.min.x = -5\nvolume.min.y = -5\n" +
           "volume.min.z = -5\nvolume.max.x = 5\nvolume.max.y = 5\nvolume.max.z = 5\n";
  };
  Json request{{"page", "a"}, {"panel", "planner"}, {"scene", cfg("cube.off")}, {"folder", ""}, {"ompl", "RRTConnect"}};
  Computed computed = compute(studio, request);
  CHECK(computed.report["answer"]["status"] == "path");
  CHECK(computed.report["start"] == Json({"3", "0", "0"}));
  CHECK(computed.report["ompl"]["status"] == "path");
  CHECK(computed.report["ompl"]["length"].get<double>() >= 6);
  CHECK(computed.scene["layers"].back()["name"] == "path of RRTConnect");
  request["dragged"] = true;
  CHECK(!compute(studio, request).report.contains("ompl"));
  request["ompl"] = "None";
  answer(studio, "compute", request, 422);
  request["ompl"] = "";
  for (const char* file : {"../outside.off", "link.off", "/etc/passwd"}) {
    request["scene"] = cfg(file);
    CHECK(answer(studio, "compute", request, 422)["error"].get<std::string>().find("below the folder") !=
          std::string::npos);
  }
  request["scene"] = "[problem]\nrobot\n";
  answer(studio, "compute", request, 422);
}

TEST_CASE("Hulls: views switched off, and images of the scene") {
  const Place place;
  fs::copy(fs::path(source_folder()) / "data/visual_hull/eight", place.root, fs::copy_options::recursive);
  Studio studio({.root = place.root}, [] {});
  Json request{{"page", "a"},     {"panel", "hulls"}, {"scene", "eight.json"}, {"off", Json::array()},
               {"simplify", "2"}, {"threshold", ""},  {"residuals", true}};
  Computed all = compute(studio, request);
  CHECK(all.report["views"].size() == 12);
  CHECK(all.report["views"][3]["inside"] == true);
  CHECK(all.report["views"][3]["residual"].get<double>() < 0.2);
  const double volume = all.report["result"]["volume_double"];
  CHECK(volume > 0);
  CHECK(all.report["views"][3]["score"].is_number());
  CHECK(all.report["overlay"].is_null());
  CHECK(!all.scene["layers"][0].contains("surface"));
  // The image of a view, and colours of the images.
  request["overlay"] = 3;
  request["colors"] = "vertices";
  all = compute(studio, request);
  CHECK(all.report["overlay"]["view"] == 3);
  CHECK(all.report["overlay"]["url"].get<std::string>().starts_with("data:image/png;base64,iVBOR"));
  CHECK(all.scene["layers"][0].contains("surface"));
  // Files of the hull have them, if they can; no file is written beside.
  const auto write = [&](const std::string& name) {
    return answer(studio, "export", {{"page", "a"}, {"set", "result"}, {"name", name}});
  };
  CHECK(write("hull.ply").dump().find("no colours") == std::string::npos);
  std::ifstream ply(place.root / "hull.ply", std::ios::binary);
  std::string line;
  bool red = false;
  while (std::getline(ply, line) && line != "end_header") red = red || line == "property uchar red";
  CHECK(red);
  CHECK(write("hull.stl")["notes"][0].get<std::string>().find("the file has no colours: PLY") == 0);
  request["colors"] = "texture";
  compute(studio, request);
  write("hull.glb");
  const std::string glb = read_file((place.root / "hull.glb").string());
  CHECK(glb.find("\"image/png\"") != std::string::npos);
  CHECK(write("textured.ply")["notes"].back().get<std::string>().find("GLB and 3MF store them") != std::string::npos);
  CHECK(!fs::exists(place.root / "textured_texture.png"));
  request["colors"] = "loud";
  CHECK(answer(studio, "compute", request, 422)["field"] == "colors");
  request["colors"] = "plain";
  request["mask"] = "magic";
  answer(studio, "compute", request, 422);
  request["mask"] = "background:../outside.off";
  answer(studio, "compute", request, 422);
  request["mask"] = "";
  request["off"] = {0, 5};
  const Computed some = compute(studio, request);
  CHECK(some.report["views"][5]["on"] == false);
  CHECK(some.report["views"].size() == 12);
  CHECK(some.report["overlay"]["view"] == 3);
  CHECK(some.report["result"]["volume_double"].get<double>() > volume);
  CHECK(some.scene["layers"].size() == 2);  // the hull, and cameras with their outlines
  request["off"] = Json::array({12});
  answer(studio, "compute", request, 422);
  request["off"] = Json::array();
  request["simplify"] = "much";
  CHECK(answer(studio, "compute", request, 422)["field"] == "simplify");
  request["simplify"] = "0";
  request["threshold"] = "bright";
  answer(studio, "compute", request, 422);
  request["threshold"] = "";
  // An image that is edited: the hull of the new one, then again that of the old one.
  request["residuals"] = false;
  request["simplify"] = "2";
  const fs::path image = place.root / "eight_02.png";
  fs::copy_file(image, fs::path(place.path()) / "kept.png");
  fs::copy_file(place.root / "eight_03.png", image, fs::copy_options::overwrite_existing);
  fs::last_write_time(image, fs::file_time_type::clock::now() + std::chrono::seconds(5));
  const double edited = compute(studio, request).report["result"]["volume_double"];
  CHECK(edited != volume);
  fs::copy_file(fs::path(place.path()) / "kept.png", image, fs::copy_options::overwrite_existing);
  fs::last_write_time(image, fs::file_time_type::clock::now() + std::chrono::seconds(10));
  CHECK(compute(studio, request).report["result"]["volume_double"].get<double>() == volume);
  request["simplify"] = "0";
  // An image that is not below the root.
  fs::rename(place.root / "eight_03.png", fs::path(place.path()) / "eight_03.png");
  fs::create_symlink("../eight_03.png", place.root / "eight_03.png");
  const Json error = answer(studio, "compute", request, 422);
  CHECK(error["error"].get<std::string>().find("below the folder") != std::string::npos);
}

TEST_CASE("The state is kept in a file, and no page overwrites what another one has saved") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  Json begin = answer(studio, "start", {});
  CHECK(begin["state"].is_null());
  CHECK(begin["state_file"] == "studio.nefstudio");
  CHECK(begin["language"]["functions"].size() > 20);
  const Json kept = answer(studio, "state", {{"text", "{\"nefstudio\": 1}"}, {"revision", begin["revision"]}});
  answer(studio, "state", {{"text", "{}"}, {"revision", begin["revision"]}}, 422);
  Studio again({.root = place.root}, [] {});
  CHECK(answer(again, "start", {})["state"] == "{\"nefstudio\": 1}");
  answer(studio, "state", {{"text", "{}"}, {"revision", kept["revision"]}});
  answer(studio, "state", {{"text", "{\"b\": 2}"}, {"revision", 0}, {"overwrite", true}});
  CHECK(answer(studio, "start", {})["state"] == "{\"b\": 2}");
  Studio named({.root = place.root, .files = {"cube.off", "studio.nefstudio"}}, [] {});
  CHECK(answer(named, "start", {})["files"] == Json::array({"cube.off"}));
  CHECK_THROWS_AS(Studio({.root = place.root, .files = {"../outside.off"}}, [] {}), InputError);
}

TEST_CASE("A state is computed without a page") {
  const Place place;
  fs::copy(fs::path(source_folder()) / "data/visual_hull/eight", place.root, fs::copy_options::recursive);
  const StudioOptions options{.root = place.root, .files = {"a.nefstudio"}};
  const auto run = [&](const Json& state, const std::string& output) {
    std::ofstream(place.root / "a.nefstudio") << state.dump();
    std::ostringstream report;
    run_state(options, output, report);
    return Json::parse(report.str());
  };
  const std::string output = (fs::path(place.path()) / "out.off").string();
  Json state{{"nefstudio", 1}, {"panel", "sets"}};
  CHECK_THROWS_AS(run(state, ""), InputError);
  state["sets"] = {{"text", "file(\"cube.off\") + box(2,0,0, 3,1,1)"}, {"live", true}, {"crossings", "union"}};
  state["sums"] = {
      {"a", "box(0,0,0, 2,2,2)"}, {"b", "box(0,0,0, 1,1,1)"}, {"kind", "sum"}, {"radius", "1"}, {"splits", 3}};
  state["hulls"] = {{"scene", "eight.json"}, {"off", {1}}, {"simplify", "2"}, {"threshold", ""}, {"residuals", false}};
  state["planner"] = {{"text", R"~({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(5,5,5, 6,6,6)"]})~"},
                      {"folder", ""},
                      {"moves", Json::object()},
                      {"free", true},
                      {"start", {"0", "0", "0"}},
                      {"goal", {"9", "9", "9"}}};
  CHECK(run(state, output)["result"]["volume"] == "2");
  CHECK(volume(read_polyhedron(output)) == Rational(2));
  state["panel"] = "sums";
  CHECK(run(state, output)["result"]["volume"] == "27");
  CHECK(volume(read_polyhedron(output)) == Rational(27));
  state["panel"] = "hulls";
  CHECK(run(state, "")["views"][1]["on"] == false);
  state["panel"] = "planner";
  CHECK(run(state, "")["answer"]["status"] == "path");
  state["panel"] = "none";
  CHECK_THROWS_AS(run(state, ""), InputError);
  CHECK_THROWS_AS(run(Json::array(), ""), InputError);
}

TEST_CASE("Text files and uploads") {
  const Place place;
  bool stopped = false;
  Studio studio({.root = place.root}, [&stopped] { stopped = true; });
  answer(studio, "write", {{"name", "scene.json"}, {"text", "{}"}});
  answer(studio, "write", {{"name", "scene.json"}, {"text", "[]"}}, 422);
  CHECK(answer(studio, "read", {{"name", "scene.json"}})["text"] == "{}");
  answer(studio, "write", {{"name", "run.sh"}, {"text", "x"}}, 422);
  answer(studio, "write", {{"name", "../scene.json"}, {"text", "x"}}, 422);
  answer(studio, "read", {{"name", "cube.off"}}, 422);
  const auto upload = [&studio](const std::string& body) {
    return studio.answer({"POST", "/api/upload", body}).status;
  };
  CHECK(upload("new.off\nOFF\n") == 200);
  CHECK(upload("new.off\nOFF\n") == 200);
  CHECK(upload("new.off\nother") == 422);
  CHECK(upload("../new.off\nx") == 422);
  CHECK(upload("new.exe\nx") == 422);
  CHECK(upload("no line") == 422);
  CHECK(answer(studio, "files", {})["files"].size() == 3);
  CHECK(!stopped);
  answer(studio, "stop", {});
  CHECK(stopped);
}

TEST_CASE("A computation is cancelled while it runs") {
  const Place place;
  Studio studio({.root = place.root}, [] {});
  int status = 0;
  std::thread computing([&] {
    status =
        studio
            .answer(
                {"POST", "/api/compute",
                 R"~({"page": "a", "panel": "sets", "text": "minkowski(sphere(1, 100) - box(0,0,0, 1,1,1), sphere(1, 90))"})~"})
            .status;
  });
  while (!answer(studio, "progress", {})["running"].get<bool>()) std::this_thread::yield();
  answer(studio, "cancel", {});
  computing.join();
  CHECK(status == 409);
  CHECK(answer(studio, "progress", {})["running"] == false);
}

}  // namespace
}  // namespace nef::studio
