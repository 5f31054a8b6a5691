// SPDX-License-Identifier: Apache-2.0
//
// Every scene and assembly that is shipped: the command `planner` and the library say the same, whatever the options.
// python/tests/apps/test_scenes.py compares the command with the package in the same way.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/clearance/widest.h"
#include "apps/planner/ompl/tight_planner.h"
#include "apps/planner/path/question.h"
#include "apps/planner/turning/turning_search.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"
#include "tests/planner/command_helpers.h"

namespace nef::planner::test {
namespace {

using nlohmann::json;

std::vector<std::string> files_of(const std::string& folder, const std::set<std::string>& extensions) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(source_folder() + "/data/planner/" + folder)) {
    if (extensions.contains(entry.path().extension().string())) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> files = files_of("", {".json"});
  for (const std::string& file : files_of("omplapp", {".cfg"})) files.push_back(file);
  return files;
}

json report_of(const Run& run) {
  REQUIRE(run.code != 2);
  return json::parse(run.out);
}

std::vector<Rational3> points_of(const json& path) {
  std::vector<Rational3> points;
  for (const json& point : path) points.push_back(point_of(point, "path"));
  return points;
}

// An option of the command, and what means the same to the library.
struct Option {
  const char* text;
  std::function<void(Scene&, PathOptions&)> apply;
};

std::vector<Option> options_of_translations() {
  return {
      {"", [](Scene&, PathOptions&) {}},
      {"--raw", [](Scene&, PathOptions& o) { o.raw = true; }},
      {"--clearance", [](Scene&, PathOptions& o) { o.clearance = true; }},
      {"--prefer roomy", [](Scene&, PathOptions& o) { o.roomy = true; }},
      {"--quick", [](Scene&, PathOptions& o) { o.thorough = false; }},
      {"--digits 1", [](Scene&, PathOptions& o) { o.digits = 1; }},
      {"--min-dimension 1", [](Scene&, PathOptions& o) { o.min_dimension = 1; }},
      {"--min-dimension 2", [](Scene&, PathOptions& o) { o.min_dimension = 2; }},
      {"--min-dimension 3", [](Scene&, PathOptions& o) { o.min_dimension = 3; }},
      {"--contact forbid", [](Scene& s, PathOptions&) { s.contact = ContactRule::kForbid; }},
      {"--contact forbid --clearance",
       [](Scene& s, PathOptions& o) {
         s.contact = ContactRule::kForbid;
         o.clearance = true;
       }},
      {"--keep-clear 1/16", [](Scene& s, PathOptions&) { keep_clear(s, Rational(1, 16)); }},
  };
}

void compare_translations(const Folder& folder, const std::string& file, const Scene& scene) {
  for (const Option& option : options_of_translations()) {
    INFO(option.text);
    Scene asked = scene;
    PathOptions options;
    option.apply(asked, options);
    const Problem problem(asked);
    const Answer answer = problem.solve(options);
    const json report = report_of(planner(folder, file + " --json " + option.text));
    CHECK(report["motions"] == "translation");
    if (answer.path) {
      REQUIRE(report["status"] == "path");
      CHECK(points_of(report["path"]) == answer.path->points);
      CHECK(report["length"] == answer.path->length);
      CHECK(problem.check(points_of(report["path"])).status == Answer::Status::kPath);
    } else {
      CHECK(report["status"] == (answer.status == Answer::Status::kInfeasible     ? "infeasible"
                                 : answer.status == Answer::Status::kInvalidStart ? "invalid_start"
                                                                                  : "invalid_goal"));
      CHECK(report.contains("collision") == answer.collision.has_value());
    }
    if (report["tight"].is_null()) continue;  // start or goal is not free, or there is a path with room
    REQUIRE(report["tight"].size() == problem.free_space().passages().size());
    for (std::size_t i = 0; i < report["tight"].size(); ++i) {
      CHECK(report["tight"][i]["dimension"] == problem.free_space().passages()[i].dimension);
    }
  }
}

void compare_turning(const Folder& folder, const std::string& file, const Scene& scene) {
  for (const auto& [text, cells] : {std::pair("", std::size_t{2000}), std::pair("--max-cells 4", std::size_t{4})}) {
    INFO(text);
    TurningLimits limits;
    limits.max_cells = cells;
    const TurningAnswer answer = find_turning_path(scene, question_of(scene), limits);
    const json report = report_of(planner(folder, file + " --json " + text));
    CHECK(report["motions"] == "translation and turning");
    CHECK(report["cells"] == answer.cells);
    CHECK((report["status"] == "path") == (answer.status == TurningAnswer::Status::kPath));
    CHECK((report["status"] == "undecided") == (answer.status == TurningAnswer::Status::kUndecided));
    const json path = report.value("path", json::array());
    REQUIRE(path.size() == answer.path.size());
    for (std::size_t i = 0; i < answer.path.size(); ++i) {
      CHECK(point_of(path[i]["position"], "path") == answer.path[i].position);
    }
  }
}

TEST_CASE("shipped scenes: the command and the library say the same with every option") {
  const Folder folder;
  int turning = 0;
  for (const std::string& file : shipped_scenes()) {
    INFO(file);
    const Scene scene = read_scene(file);
    REQUIRE(scene.start.has_value());
    REQUIRE(scene.goal.has_value());
    if (scene.rotation) {
      ++turning;
      compare_turning(folder, file, scene);
      // Nothing about translations takes it for a scene of one orientation.
      CHECK_THROWS_AS(Problem(scene), InputError);
      CHECK_THROWS_AS(free_positions(scene), InputError);
      CHECK_THROWS_AS(free_space_builder(scene), InputError);
      for (const char* other : {"--tight", "--raw", "--quick", "--prefer roomy", "--clearance", "--min-dimension 1"}) {
        CHECK(planner(folder, file + " " + other).code == 2);
      }
    } else {
      compare_translations(folder, file, scene);
    }
  }
  CHECK(turning >= 2);
}

TEST_CASE("shipped assemblies: the command and the library say the same") {
  const Folder folder;
  for (const std::string& file : files_of("assembly", {".json"})) {
    INFO(file);
    const Assembly assembly = read_assembly(file);
    const Disassembly answer = take_apart(assembly);
    const json report = report_of(planner(folder, "--assembly " + file + " --json"));
    const char* const turning = assembly.turns_freely ? "rigid" : "translation and turning";
    CHECK(report["motions"] == (assembly.turns() ? turning : "translation"));
    CHECK((report["status"] == "sequence") == (answer.inseparable.empty() && !answer.overlap));
    REQUIRE(report["steps"].size() == answer.steps.size());
    for (std::size_t i = 0; i < answer.steps.size(); ++i) {
      CHECK(points_of(report["steps"][i]["path"]) == answer.steps[i].path);
      CHECK(report["steps"][i]["parts"].size() == answer.steps[i].parts.size());
    }
  }
}

}  // namespace
}  // namespace nef::planner::test
