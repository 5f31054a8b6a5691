// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/queries.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/planner/command_helpers.h"
#include "tests/support/report_shape.h"

namespace nef::planner::test {
namespace {

TEST_CASE("many questions about one scene") {
  const Folder folder;
  const std::string scene = folder.write("scene.json", R"J({"robot": "box(0,0,0, 1,1,1)",
    "obstacles": ["box(4,-9,-9, 5,9,9) - box(4,0,0, 5,1,1)"], "box": [[0,-8,-8],[9,8,8]]})J");
  const std::string lines = folder.write("lines.txt", "0 0 0 9 0 0\n\n1/3,0,0, 2,2,2\n");
  const Run run = planner(folder, scene + " --queries " + lines);
  CHECK(run.code == 0);
  CHECK(run.out == "path, length 9\npath, length 3.28295\n");
  const std::string list = folder.write("list.json", R"J([{"start": [0,0,0], "goal": ["1/2",0,0]},
    {"start": [0,0,0], "goal": [4,4,4]}, {"start": [20,0,0], "goal": [0,0,0]}])J");
  const Run report = planner(folder, scene + " --json --queries " + list);
  CHECK(report.code == 3);
  nef::test::check_report_shape(nlohmann::json::parse(report.out), "queries");
  const nlohmann::json answers = nlohmann::json::parse(report.out)["queries"];
  REQUIRE(answers.size() == 3);
  CHECK(answers[0]["status"] == "path");
  CHECK(answers[0]["goal"][0] == "1/2");
  CHECK(answers[1]["status"] == "invalid_goal");
  CHECK(answers[2]["status"] == "invalid_start");
  for (const char* bad : {"", "1 2 3\n", "[]", "[1]", "[{\"start\": [0,0,0]}]", "a b c d e f\n"}) {
    const Run wrong = planner(folder, scene + " --queries " + folder.write("bad", bad));
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("bad"));
  }
  CHECK(planner(folder, scene + " --queries " + lines + " -o x.path").code == 2);
}

}  // namespace
}  // namespace nef::planner::test
