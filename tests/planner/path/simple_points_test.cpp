// SPDX-License-Identifier: Apache-2.0
//
// Way-points without needless wobble, and with no more digits than wanted.
#include "apps/planner/path/simple_points.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "apps/program/reports/exact_json.h"
#include "nef/construct/construct.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

double length_of(const std::vector<Rational3>& path) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) sum += distance(path[i], path[i + 1]);
  return sum;
}

TEST_CASE("a wobble goes where nothing asks for it, and stays where something does") {
  const std::vector<Rational3> wobbling{{0, 0, 0}, {1, 2, ratio(-27, 10000)}, {2, 2, ratio(1, 1000)}, {3, 0, 0}};
  std::vector<Rational3> path = wobbling;
  straighten([](const Rational3&, const Rational3&) { return true; }, path);
  for (const Rational3& point : path) CHECK(point[2] == 0);
  // Nothing below z = 1/1000 may be used in the middle: the whole cannot be flat, and no length is gained elsewhere.
  path = wobbling;
  const auto high = [](const Rational3& p) { return p[0] <= 1 || p[0] >= 3 || p[2] >= ratio(1, 1000); };
  straighten([&](const Rational3& a, const Rational3& b) { return high(a) && high(b) && b[0] == a[0] + 1; }, path);
  CHECK(path[1][2] == 0);
  CHECK(path[2][2] == ratio(1, 1000));
  CHECK(length_of(path) <= length_of(wobbling));
}

TEST_CASE("rounded points: the nearest first, all coordinates before some, never the point itself") {
  CHECK(rounded(ratio(1, 3), 2) == ratio(33, 100));
  CHECK(rounded(ratio(-1, 3), 0) == 0);
  CHECK(rounded(ratio(-2, 3), 1) == ratio(-7, 10));
  const std::vector<Rational3> points = rounded_points({ratio(1, 3), ratio(1, 2), 1}, 1);
  REQUIRE_FALSE(points.empty());
  CHECK(points.front() == Rational3{ratio(3, 10), ratio(1, 2), 1});
  for (const Rational3& p : points) CHECK(p != Rational3{ratio(1, 3), ratio(1, 2), 1});
  CHECK(rounded_points({1, 2, 3}, 0).empty());
}

TEST_CASE("paths of so many digits are free, as long as the others but for that, and say where they have more") {
  std::size_t rounded_count = 0;
  for (unsigned seed = 0; seed < nef::test::fewer(6); ++seed) {
    std::mt19937 random(seed);
    const auto number = [&](int low, int high) {
      return ratio(std::uniform_int_distribution<int>(low, high)(random), 7);
    };
    Scene scene;
    scene.robot = unite(make_box({0, 0, 0}, {2, 1, 1}), make_box({0, 0, 0}, {1, 1, 2}));
    for (int i = 0; i < 12; ++i) {
      const Rational3 low{number(7, 49), number(7, 49), number(7, 49)};
      const Polyhedron box = make_box({0, 0, 0}, {number(7, 21), number(7, 21), number(7, 21)});
      AffineMap map = AffineMap::rotate({1, 2, 2}, i % 3 == 0 ? 37 : 0);
      map.translation = low;
      scene.obstacles.push_back(transform(box, map));
      scene.obstacle_names.emplace_back("box");
    }
    scene.start = Rational3{-3, -3, -3};
    scene.goal = Rational3{ratio(41, 4), ratio(38, 4), ratio(37, 4)};
    const Problem problem(scene);
    const Answer exact = problem.solve();
    REQUIRE(exact.path.has_value());
    CHECK(exact.path->unrounded.empty());
    for (const unsigned digits : {1U, 3U, 9U}) {
      PathOptions options;
      options.digits = digits;
      const Answer answer = problem.solve(options);
      REQUIRE(answer.path.has_value());
      const ExactPath& path = *answer.path;
      CHECK(independent_complaint(scene, problem.free_space().set(), path, false) == "");
      CHECK(path.length < exact.path->length + 4 * std::pow(0.1, digits) * static_cast<double>(path.points.size()));
      for (std::size_t i = 1; i + 1 < path.points.size(); ++i) {
        const bool named = std::find(path.unrounded.begin(), path.unrounded.end(), i) != path.unrounded.end();
        CHECK(is_rounded(path.points[i], digits) != named);
        rounded_count += named ? 0 : 1;
      }
    }
  }
  CHECK(rounded_count > 10);
}

TEST_CASE("a tunnel without width at thirds keeps them, and the command says so") {
  const Folder folder;
  const std::string tunnel = folder.write("tunnel.json", R"J({"robot": "box(0,0,0, 1,1,1)",
    "obstacles": ["box(3,-9,-9, 5,9,9) - interior(box(2,1/3,1/3, 6,4/3,4/3))"], "start": [0,0,0], "goal": [7,1,0]})J");
  const Run run = planner(folder, tunnel + " --digits 3 --json");
  REQUIRE(run.code == 0);
  const nlohmann::json report = nlohmann::json::parse(run.out);
  CHECK(report["unrounded"] == nlohmann::json{1, 2});
  for (const std::size_t i : {1U, 2U}) {
    CHECK(report["path"][i][1] == "1/3");
    CHECK(report["path"][i][2] == "1/3");
  }
  CHECK_THAT(planner(folder, tunnel + " --digits 3").out,
             Catch::Contains("more decimals than --digits") && Catch::Contains(": 1 2\n"));
  const Run open = planner(folder, scene("s2_tight_slot") + " --digits 2");
  CHECK_THAT(open.out, Catch::Contains("3 1 0.84\n5 1 1.16\n"));
  CHECK(planner(folder, tunnel + " --digits -1").code == 2);
  CHECK(planner(folder, tunnel + " --quick").code == 0);
}

}  // namespace
}  // namespace nef::planner::test
