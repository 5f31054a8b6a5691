// SPDX-License-Identifier: Apache-2.0
//
// Paths past surfaces, of which only the faces near the path are asked about: against the free space of all of them.
#include "apps/planner/path/partial_answer.h"

#include <catch2/catch.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/planner/command_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

// A sheet from (0, 0) to (12, 12) with a height at each whole x and y, as a file; squares that `holes` takes are left
// out.
std::string sheet_text(unsigned seed, const std::function<bool(int, int)>& holes) {
  constexpr int kSide = 12;
  std::mt19937 random(seed);
  std::string vertices;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      vertices += std::to_string(x) + ' ' + std::to_string(y) + " 0." + std::to_string(random() % 9) + '\n';
    }
  }
  std::string faces;
  int count = 0;
  const auto face = [&](int a, int b, int c) {
    faces += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
    ++count;
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (holes(x, y)) continue;
      const int at = y * (kSide + 1) + x;
      face(at, at + 1, at + kSide + 2);
      face(at, at + kSide + 2, at + kSide + 1);
    }
  }
  return "OFF\n" + std::to_string((kSide + 1) * (kSide + 1)) + ' ' + std::to_string(count) + " 0\n" + vertices + faces;
}

TEST_CASE("past surfaces, the parts that are near the path give the path that all of them give") {
  const Folder folder;
  const auto no_hole = [](int, int) { return false; };
  const std::string way = folder.file("way.json");
  const auto corner = [](int x, int y) { return x > 8 && y > 5 && y < 9; };
  for (unsigned seed = 0; seed < nef::test::fewer(6); ++seed) {
    INFO("seed " << seed);
    static_cast<void>(folder.write("sheet.off", seed % 2 == 0 ? sheet_text(seed, no_hole) : sheet_text(seed, corner)));
    const std::string scene = folder.write("scene.json", R"J({"robot": "hull([0,0,0], [1/2,0,0], [0,1/2,0], [0,0,1/2])",
      "obstacles": ["sheet.off", "box(3,3,2, 5,5,3)"], "start": [7,6,-3], "goal": [4,)J" +
                                                             std::to_string(seed + 3) + ",4]}");
    const nlohmann::json some = nlohmann::json::parse(planner(folder, scene + " --json -o " + way).out);
    const nlohmann::json all = nlohmann::json::parse(planner(folder, scene + " --json --tight").out);
    REQUIRE(some["status"] == "path");
    CHECK(some["tight"].is_null());
    CHECK(all["tight"].is_array());
    CHECK(some["thinnest_piece"] == all["thinnest_piece"]);
    CHECK(some["thinnest_junction"] == all["thinnest_junction"]);
    CHECK(some["length"].get<double>() == Approx(all["length"].get<double>()).epsilon(0.01));
    CHECK(planner(folder, scene + " --path " + way).code == 0);
  }
}

TEST_CASE("where surfaces leave no way, or a tight one only, all of them are asked") {
  const Folder folder;
  const auto hole = [](int x, int y) { return x == 6 && y == 6; };
  static_cast<void>(folder.write("sheet.off", sheet_text(1, hole)));
  const auto scene = [&](const std::string& width) {
    return folder.write("scene.json", R"J({"robot": "box(0,0,0, )J" + width + R"J(,1,1)", "obstacles": ["sheet.off"],
      "box": [[0,0,-5],[11,11,5]], "start": [2,2,-4], "goal": [3,2,4]})J");
  };
  const nlohmann::json through = nlohmann::json::parse(planner(folder, scene("1") + " --json").out);
  CHECK(through["status"] == "path");
  CHECK(through["tight"].is_array());
  CHECK(through["thinnest_piece"].get<int>() < 3);
  CHECK(planner(folder, scene("1.001") + " --json").code == 1);
}

}  // namespace
}  // namespace nef::planner::test
