// SPDX-License-Identifier: Apache-2.0
//
// Robots that turn: the program's options, reports and errors, and what pages and glTF files show of the motion.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "apps/planner/command/runs/runs.h"
#include "apps/planner/command/scene_view.h"
#include "apps/planner/turning/turning_search.h"
#include "apps/program/reports/exact_json.h"
#include "apps/view/glb.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/report_shape.h"

namespace nef::planner::test {
namespace {

TEST_CASE("turning on the command line") {
  const Folder folder;
  const std::string scene = folder.write("corner.json", corner("3.5"));
  const Run run = planner(folder, scene + " --json");
  CHECK(run.code == 0);
  const nlohmann::json report = nlohmann::json::parse(run.out);
  CHECK(report["status"] == "path");
  nef::test::check_report_shape(report, "turning");
  CHECK(report["path"].front()["turn"]["degrees"] == 0.0);
  CHECK(report["path"].back()["turn"]["quarters"] == 1);
  CHECK(report["path"].back()["position"][1] == "12");
  const std::string too_long = folder.write("long.json", corner("3.9"));
  CHECK(planner(folder, too_long + " --quiet -o " + folder.file("proof.json")).code == 1);
  const Run checked = planner(folder, too_long + " --check-proof " + folder.file("proof.json"));
  CHECK(checked.code == 0);
  CHECK_THAT(checked.out, Catch::StartsWith("the proof holds, "));
  const Run other = planner(folder, scene + " --json --check-proof " + folder.file("proof.json"));
  CHECK(other.code == 1);
  CHECK(nlohmann::json::parse(other.out)["holds"] == false);
  for (const char* broken : {"{}", R"({"proof": 3})", R"({"proof": {"breakpoints": [3], "cells": []}})",
                             R"({"proof": {"breakpoints": [], "cells": [{"inner": [[]], "start_side": []}]}})"}) {
    CHECK(planner(folder, too_long + " --check-proof " + folder.write("broken.json", broken)).code == 2);
  }
  const Run open = planner(folder, folder.write("limit.json", corner("3.6568")) + " --max-cells 5");
  CHECK(open.code == 5);
  CHECK_THAT(open.out, Catch::Contains("undecided") && Catch::Contains("open:"));
  const Run elsewhere = planner(folder, scene + " --json --digits 1 --start -11,-1,0,15 --goal -1,11,0");
  CHECK(elsewhere.code == 0);
  const nlohmann::json moved = nlohmann::json::parse(elsewhere.out);
  CHECK(moved["path"].front()["position"][0] == "-11");
  CHECK(moved["path"].front()["turn"]["degrees"] == Approx(15));
  CHECK(moved["path"].back()["turn"]["quarters"] == 1);
  CHECK(moved["unrounded"].is_array());
  CHECK(planner(folder, scene + " --start 1,2").code == 2);
  CHECK(planner(folder, nef::planner::test::scene("s1_tight_hole") + " --start 1,0.5,0.5,3").code == 2);
  CHECK(planner(folder, scene + " --tight").code == 2);
  CHECK(planner(folder, scene + " -o x.path").code == 2);
  CHECK(planner(folder, scene + " --quiet -o " + folder.file("way.txt")).code == 0);
  CHECK(text_of(folder.file("way.txt")).substr(0, 10) == "-12 -1 0 0");
  for (const char* bad : {R"("w")", R"({"axis": "w"})", R"({"axis": [0,0,0]})", R"({"axis": [1,0]})",
                          R"({"range": [5, 0]})", R"({"turn": 3})", R"({"range": [0, 40000]})"}) {
    const std::string text = R"J({"robot": "box(0,0,0,1,1,1)", "obstacles": [], "start": [0,0,0,0], "goal": [1,0,0,0],
      "rotation": )J" + std::string(bad) +
                             "}";
    CHECK(planner(folder, folder.write("bad.json", text)).code == 2);
  }
}

// What a node of a glTF animation does at a time, as a viewer plays it: the image of a point of the layer's
// coordinates.
TEST_CASE("the motion in pages and glTF files takes every corner of the robot where the way-points do") {
  for (const char* axis : {R"("z")", "[1, 1, 1]"}) {
    const Scene scene = scene_of(R"J({"robot": "box(-1,-1/4,0, 3,1/4,1)", "obstacles": ["box(5,5,5,6,6,6)"],
      "start": [3,4,5, 350], "goal": [9,4,5, 80], "rotation": {"axis": )J" +
                                 std::string(axis) + "}}");
    const TurningQuestion question = question_of(scene);
    const TurningAnswer answer = find_turning_path(scene, question);
    REQUIRE(answer.path.size() > 1);
    const std::vector<view::Layer> layers = turning_layers(answer, scene, question);
    REQUIRE(layers.front().name == "robot");
    const view::Motion& motion = layers.front().motion;
    REQUIRE(motion.times.size() == motion.turns.size());
    CHECK(motion.times.back() == Approx(kPlaySeconds));
    AffineMap start = question.axis.rotation(question.start.turn);
    start.translation = question.start.position;
    std::size_t k = 0;
    for (std::size_t i = 0; i < answer.path.size(); ++i) {
      const Pose& pose = answer.path[i];
      if (i > 0 && pose.position == answer.path[i - 1].position && pose.turn == answer.path[i - 1].turn) continue;
      AffineMap map = question.axis.rotation(pose.turn);
      map.translation = pose.position;
      for (const Rational3& corner : {Rational3{3, ratio(1, 4), 1}, Rational3{-1, 0, 0}}) {
        const Rational3 drawn = start(corner);
        const auto [w, x, y, z] = motion.turns[k];
        CHECK(w * w + x * x + y * y + z * z == Approx(1));
        Eigen::Vector3d moved(nearest_double(drawn[0]) - motion.pivot[0], nearest_double(drawn[1]) - motion.pivot[1],
                              nearest_double(drawn[2]) - motion.pivot[2]);
        moved = Eigen::Quaterniond(w, x, y, z) * moved;
        for (std::size_t c = 0; c < 3; ++c) {
          CHECK(moved[static_cast<Eigen::Index>(c)] + motion.pivot[c] + motion.offsets[k][c] ==
                Approx(nearest_double(map(corner)[c])).margin(1e-6));
        }
      }
      ++k;
    }
    CHECK(k == motion.times.size());
    const std::string glb = view::glb_bytes(layers);
    CHECK(glb.find("\"path\":\"rotation\"") != std::string::npos);
  }
}

}  // namespace
}  // namespace nef::planner::test
