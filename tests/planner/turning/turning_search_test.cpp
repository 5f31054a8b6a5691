// SPDX-License-Identifier: Apache-2.0
//
// Robots that turn about one axis: paths are checked pose by pose against the definition, proofs against scenes whose
// answer is known in closed form and against a fine grid.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/free_space/free_space.h"
#include "apps/planner/turning/turning_collision.h"
#include "apps/planner/turning/turning_robot.h"
#include "apps/planner/turning/turning_search.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

// The robot in no obstacle, at poses all along every motion; one coordinate changes at a time.
void check_path(const Scene& scene, const TurningQuestion& question, const TurningAnswer& answer) {
  REQUIRE(answer.path.size() > 0);
  CHECK(answer.path.front().position == question.start.position);
  CHECK(answer.path.back().position == question.goal.position);
  CHECK(answer.path.front().turn == question.start.turn);
  const Rational full_turns = (answer.path.back().turn - question.goal.turn) / 4;
  CHECK(full_turns.get_den() == 1);
  CHECK((full_turns == 0 || question.high - question.low == 4));
  const Polyhedron obstacles = unite_all(scene.obstacles);
  for (std::size_t i = 0; i + 1 < answer.path.size(); ++i) {
    const Pose& from = answer.path[i];
    const Pose& to = answer.path[i + 1];
    CHECK((from.turn == to.turn || from.position == to.position));
    for (int k = 0; k <= 3; ++k) {
      const Rational t = ratio(k, 3);
      Rational3 x = from.position;
      for (std::size_t c = 0; c < 3; ++c) x[c] += t * (to.position[c] - from.position[c]);
      const Polyhedron body =
          transform(transform(scene.robot, question.axis.rotation(from.turn + t * (to.turn - from.turn))),
                    AffineMap::translate(x));
      CHECK(intersect(interior(body), obstacles).is_empty());
      if (scene.box) CHECK(contains(make_box((*scene.box)[0], (*scene.box)[1]), x));
    }
  }
}

TEST_CASE("a bar round the corner of a corridor: the limit is known") {
  for (const auto& [length, fits] : {std::pair("3.62", true), std::pair("3.5", true), std::pair("3.70", false)}) {
    INFO(length);
    const Scene scene = scene_of(corner(length));
    const TurningQuestion question = question_of(scene);
    const TurningAnswer answer = find_turning_path(scene, question);
    CHECK(answer.status == (fits ? TurningAnswer::Status::kPath : TurningAnswer::Status::kInfeasible));
    CHECK(answer.cells < 50);
    if (fits) check_path(scene, question, answer);
  }
}

TEST_CASE("the corner turned in space: the same limit about any axis") {
  // Rotations that take z to the axis.
  for (const auto& [matrix, axis, range] :
       {std::tuple("2/3,-1/3,2/3,0, 1/3,-2/3,-2/3,0, 2/3,2/3,-1/3,0", "[2, -2, -1]", "[0, 90]"),
        std::tuple("1,0,0,0, 0,0,-1,0, 0,1,0,0", "[0, -1, 0]", "[-5, 95]"),
        std::tuple("0,0,1,0, 1,0,0,0, 0,1,0,0", "x", "[-180, 180]")}) {
    for (const auto& [length, fits] : {std::pair("3.5", true), std::pair("3.9", false)}) {
      INFO(axis << ' ' << length);
      nlohmann::json json = nlohmann::json::parse(corner(length));
      const auto turned = [by = std::string(matrix)](const std::string& shape) {
        return "transform(" + shape + ", " + by + ")";
      };
      json["robot"] = turned(json["robot"]);
      json["obstacles"][0] = turned(json["obstacles"][0]);
      // In place of the box of the reference point a floor and a ceiling that the bar just fits between.
      json["obstacles"][1] = turned("box(-40,-40,-2, 40,40,3) - interior(box(-15,-15,0, 15,15,1))");
      json.erase("box");
      AffineMap map = AffineMap::identity();
      std::istringstream numbers(matrix);
      std::string number;
      for (std::size_t k = 0; k < 12 && std::getline(numbers, number, ','); ++k) {
        if (k % 4 != 3) map.linear[k / 4][k % 4] = parse_rational(number.substr(number.find_first_not_of(' ')));
      }
      CHECK(map.determinant() == 1);
      const Scene flat = scene_of(corner(length));
      json["rotation"] = {{"axis", axis[0] == '[' ? nlohmann::json::parse(axis) : nlohmann::json(axis)},
                          {"range", nlohmann::json::parse(range)}};
      json["start"] = exact_json(map(*flat.start));
      json["goal"] = exact_json(map(*flat.goal));
      json["start"].push_back(0);
      json["goal"].push_back(90);
      const Scene scene = scene_of(json.dump());
      const TurningQuestion question = question_of(scene);
      const TurningAnswer answer = find_turning_path(scene, question);
      CHECK(answer.status == (fits ? TurningAnswer::Status::kPath : TurningAnswer::Status::kInfeasible));
      if (fits) check_path(scene, question, answer);
    }
  }
}

TEST_CASE("exact contact at an angle of parallel faces is found: a slot turned by 3-4-5") {
  // The slot is as wide as the bar. It is entered at the angle of 3-4-5 only.
  const auto slot = [](const std::string& width) {
    return scene_of(R"J({"robot": "box(-1,-1/2,0, 1,1/2,1)", "obstacles":
      ["transform(box(0,-30,-1, 4,30,2) - interior(box(-1,-)J" +
                    width + R"J(/2,-2, 5,)J" + width +
                    R"J(/2,3)), 4/5,-3/5,0,0, 3/5,4/5,0,0, 0,0,1,0)"],
      "rotation": {"axis": "z"}, "start": [-4,-3,0, 0], "goal": [8,6,0, 0],
      "box": [[-9,-9,0],[9,9,0]]})J");
  };
  for (const auto& [width, fits] : {std::pair("1", true), std::pair("1.001", true), std::pair("0.999", false)}) {
    INFO(width);
    const Scene scene = slot(width);
    const TurningQuestion question = question_of(scene);
    const TurningAnswer answer = find_turning_path(scene, question);
    // Round the block there is no way inside the box but through the slot.
    CHECK(answer.status == (fits ? TurningAnswer::Status::kPath : TurningAnswer::Status::kInfeasible));
    CHECK(answer.cells < 80);
    if (fits) check_path(scene, question, answer);
  }
}

TEST_CASE("Of ways round the ring the one over fewer cells is taken") {
  // Nothing is in the way: all cells are open, and then all are bridged.
  for (const auto& [degrees, turned] : {std::pair(90, 1), std::pair(270, -1), std::pair(360, 0), std::pair(450, 1)}) {
    INFO(degrees);
    const Scene scene = scene_of(R"J({"robot": "box(-2,-1/2,0, 2,1/2,1)", "obstacles": ["box(8,8,0, 9,9,1)"],
        "rotation": {"axis": "z"}, "start": [0,0,0, 0], "goal": [1,0,0, )J" +
                                 std::to_string(degrees) + R"J(], "box": [[-5,-5,0],[5,5,0]]})J");
    const TurningQuestion question = question_of(scene);
    const TurningAnswer answer = find_turning_path(scene, question);
    check_path(scene, question, answer);
    CHECK(answer.path.back().turn - answer.path.front().turn == turned);
    std::size_t turns = 0;
    for (std::size_t i = 1; i < answer.path.size(); ++i) {
      if (answer.path[i].turn != answer.path[i - 1].turn) ++turns;
    }
    CHECK(turns == static_cast<std::size_t>(std::abs(turned)));
  }
}

TEST_CASE("random boxes in the plane against a fine grid of poses") {
  // What the grid reaches is reachable: its steps are too small to jump over anything here. What it does not reach may
  // be reachable all the same.
  std::size_t paths = 0;
  std::size_t proofs = 0;
  for (unsigned seed = 0; seed < seeds(5); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Scene scene;
    scene.robot = make_box({-1, ratio(-1, 4), 0}, {1, ratio(1, 4), 1});
    scene.box = {Rational3{-2, -2, 0}, Rational3{10, 10, 0}};
    const auto add = [&](const Rational& x, const Rational& y, const Rational& to_x, const Rational& to_y) {
      scene.obstacles.push_back(make_box({x, y, -1}, {to_x, to_y, 2}));
      scene.obstacle_names.emplace_back("box");
    };
    // A wall with a gap that is too narrow, just wide enough, or wider; and boxes on both sides.
    const Rational gap = static_cast<int>(random() % 7);
    const std::array<Rational, 5> widths{ratio(2, 5), ratio(49, 100), ratio(1, 2), ratio(3, 5), ratio(3, 2)};
    add(3, -9, 4, gap);
    add(3, gap + widths[seed % 5], 4, 19);
    for (int i = 0; i < 4; ++i) {
      const Rational x = i % 2 == 0 ? static_cast<int>(random() % 2) : 5 + static_cast<int>(random() % 2);
      const Rational y = static_cast<int>(random() % 7);
      add(x, y, x + ratio(static_cast<long>(1 + random() % 3), 2), y + 1);
    }
    TurningQuestion question;
    question.start = {{-1, -1, 0}, 0};
    question.goal = {{ratio(19, 2), ratio(19, 2), 0}, 1};
    const TurningAnswer answer = find_turning_path(scene, question, {.max_cells = 400});
    if (answer.status == TurningAnswer::Status::kPath) {
      ++paths;
      check_path(scene, question, answer);
    }
    if (answer.status == TurningAnswer::Status::kInfeasible) {
      ++proofs;
      CHECK(complaint_about(*answer.proof, scene, question).value_or("it holds") == "it holds");
    }
    if (answer.status == TurningAnswer::Status::kInfeasible || answer.status == TurningAnswer::Status::kPath) {
      // Is the goal reached by steps of 1/4 and 1/16 of a quarter?
      constexpr int kSteps = 49;
      constexpr int kTurns = 64;  // the full circle
      std::vector<char> free(std::size_t{kSteps} * kSteps * kTurns, 0);
      const auto index = [](int i, int k, int t) {
        const int at = (t * kSteps + i) * kSteps + k;
        return static_cast<std::size_t>(at);
      };
      for (int t = 0; t < kTurns; ++t) {
        Scene slice = scene;
        slice.rotation.reset();
        slice.robot = transform(scene.robot, question.axis.rotation(ratio(t, 16)));
        const FreeSpace space(free_positions(slice));
        for (int i = 0; i < kSteps; ++i) {
          for (int k = 0; k < kSteps; ++k) {
            free[index(i, k, t)] =
                space.is_free(ExactPoint(std::array<double, 3>{i / 4.0 - 2, k / 4.0 - 2, 0})) ? 1 : 0;
          }
        }
      }
      std::vector<std::array<int, 3>> queue{{4, 4, 0}};
      std::vector<char> seen(free.size(), 0);
      bool reached = false;
      REQUIRE(free[index(4, 4, 0)] != 0);
      seen[index(4, 4, 0)] = 1;
      for (std::size_t n = 0; n < queue.size(); ++n) {
        const auto [i, k, t] = queue[n];
        reached = reached || (i == 46 && k == 46 && t == 16);
        for (const auto& [di, dk, dt] : {std::array{1, 0, 0}, std::array{-1, 0, 0}, std::array{0, 1, 0},
                                         std::array{0, -1, 0}, std::array{0, 0, 1}, std::array{0, 0, kTurns - 1}}) {
          const int ni = i + di;
          const int nk = k + dk;
          const int nt = (t + dt) % kTurns;
          if (ni < 0 || nk < 0 || ni >= kSteps || nk >= kSteps) continue;
          if (free[index(ni, nk, nt)] == 0 || seen[index(ni, nk, nt)] != 0) continue;
          seen[index(ni, nk, nt)] = 1;
          queue.push_back({ni, nk, nt});
        }
      }
      CHECK((answer.status == TurningAnswer::Status::kPath || !reached));
    }
  }
  CHECK(paths >= nef::test::fewer(5) / 2);
  CHECK(proofs >= nef::test::fewer(5) / 2);
}

TEST_CASE("a range wider than a full circle: an angle and the same a turn later are different") {
  // A bar in a room of its own, in which it may turn; a wall in the way allows angles near 0 only at x = 0.
  const auto asked = [](const std::string& range, const std::string& goal) {
    return scene_of(R"J({"robot": "box(-1,-1/4,0, 1,1/4,1)", "obstacles": ["box(9,9,9, 10,10,10)"],
      "rotation": {"axis": "z", "range": )J" +
                    range + R"J(}, "start": [0,0,0, 10], "goal": [0,0,0, )J" + goal +
                    R"J(], "box": [[-2,-2,0],[2,2,0]]})J");
  };
  const auto degrees = [](const TurningQuestion& question) {
    return std::array{question.axis.degrees_of(question.start.turn), question.axis.degrees_of(question.goal.turn)};
  };
  const Scene wound = asked("[0, 720]", "370");
  const TurningQuestion question = question_of(wound);
  CHECK_FALSE(question.is_ring());
  CHECK(degrees(question)[0] == Approx(10));
  CHECK(degrees(question)[1] == Approx(370));
  const TurningAnswer answer = find_turning_path(wound, question);
  REQUIRE(answer.status == TurningAnswer::Status::kPath);
  check_path(wound, question, answer);
  CHECK(answer.path.back().turn == question.goal.turn);
  double turned = 0;
  for (std::size_t i = 0; i + 1 < answer.path.size(); ++i) {
    turned +=
        std::fabs(question.axis.degrees_of(answer.path[i + 1].turn) - question.axis.degrees_of(answer.path[i].turn));
  }
  CHECK(turned >= 360 - 1e-6);
  // In the ring the two are the same angle. What is out of the range comes in by full turns.
  CHECK(degrees(question_of(asked("[0, 360]", "370")))[1] == Approx(10));
  CHECK(degrees(question_of(asked("[0, 720]", "-300")))[1] == Approx(60));
  CHECK_THROWS_AS(asked("[0, 36001]", "0"), InputError);
}

TEST_CASE("a joint that is blocked at one angle cannot go round it, however wide its range is") {
  // A post beside the axis at 90 degrees, and so at 450: from 10 degrees to 370 all ways pass it.
  const Scene scene = scene_of(R"J({"robot": "box(-1/4,-1/4,0, 2,1/4,1)", "obstacles": ["box(-1/8,1,-1, 1/8,3/2,2)"],
      "rotation": {"axis": "z", "range": [0, 720]}, "start": [0,0,0, 0], "goal": [0,0,0, 360],
      "box": [[0,0,0],[0,0,0]]})J");
  const TurningQuestion question = question_of(scene);
  const TurningAnswer answer = find_turning_path(scene, question);
  REQUIRE(answer.status == TurningAnswer::Status::kInfeasible);
  CHECK_FALSE(complaint_about(*answer.proof, scene, question).has_value());
}

TEST_CASE("unbounded obstacles: cut where no robot in the box can reach") {
  const Scene scene = scene_of(
      R"J({"robot": "box(-1,-1/4,0, 1,1/4,1)", "obstacles": ["halfspace(1,0,0,-4) - interior(halfspace(1,0,0,-3))",
    "box(3,1/8,-9, 4,9,9)"], "start": [0,0,0,0], "goal": [7,0,0,0], "box": [[-2,-3,0],[9,3,0]], "rotation": {}})J");
  const TurningQuestion question = question_of(scene);
  const TurningAnswer answer = find_turning_path(scene, question);
  REQUIRE(answer.status == TurningAnswer::Status::kInfeasible);
  CHECK(complaint_about(*answer.proof, scene, question).value_or("it holds") == "it holds");
  const TurningCollision collision(scene, question.axis);
  CHECK(collision.is_free(question.start));
  CHECK_FALSE(collision.is_free({{ratio(7, 2), -2, 0}, 0}));
  CHECK(collision.is_free({{2, -2, 0}, 0}));
  CHECK_FALSE(collision.is_free({{ratio(21, 10), -2, 0}, 0}));
}

}  // namespace
}  // namespace nef::planner::test
