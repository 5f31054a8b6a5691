// SPDX-License-Identifier: Apache-2.0
//
// Robots that turn about one axis: paths are checked pose by pose against the definition, proofs against scenes whose
// answer is known in closed form and against a fine grid.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/free_space/free_space.h"
#include "apps/planner/turning/clipped_polytope.h"
#include "apps/planner/turning/turning_collision.h"
#include "apps/planner/turning/turning_robot.h"
#include "apps/planner/turning/turning_search.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"
#include "nef/program/exact_json.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

Rational3 times(const Rational& factor, const Rational3& v) { return {factor * v[0], factor * v[1], factor * v[2]}; }

// Axes whose length is one, rational, and irrational.
const std::vector<Rational3>& axes() {
  static const std::vector<Rational3> result{{1, 0, 0}, {0, 1, 0},  {0, 0, 3}, {1, 2, 2},
                                             {1, 1, 1}, {-2, 3, 0}, {0, 1, -7}};
  return result;
}

TEST_CASE("turns about an axis: rational rotations by the angles that they say, in order") {
  for (const Rational3& direction : axes()) {
    const TurningAxis axis(direction);
    const double length = std::sqrt(nearest_double(dot(direction, direction)));
    const Rational3 side = is_zero(cross(direction, Rational3{1, 0, 0})) ? Rational3{0, 1, 0} : Rational3{1, 0, 0};
    const Rational3 across = cross(direction, side);
    double before = -361;
    for (const int degrees : {-360, -350, -180, -91, -1, 0, 1, 17, 45, 89, 90, 91, 180, 200, 359, 360, 377}) {
      INFO(degrees);
      const Turn turn = axis.turn_of_degrees(degrees);
      CHECK(axis.degrees_of(turn) == Approx(degrees).margin(1e-8));
      CHECK(axis.degrees_of(turn) > before);
      before = axis.degrees_of(turn);
      const AffineMap rotation = axis.rotation(turn);
      CHECK(rotation.determinant() == 1);
      CHECK(rotation(direction) == direction);
      const Rational3 image = rotation(across);
      const Rational square = dot(across, across);
      CHECK(dot(image, image) == square);
      const double radians = degrees * M_PI / 180;
      CHECK(nearest_double(dot(image, across) / square) == Approx(std::cos(radians)).margin(1e-9));
      CHECK(nearest_double(dot(direction, cross(across, image)) / square) / length ==
            Approx(std::sin(radians)).margin(1e-9));
      // The quaternion, by the formula for its matrix.
      const auto [w, x, y, z] = axis.quaternion(turn);
      const Rational norm = w * w + x * x + y * y + z * z;
      CHECK(rotation.linear[0][0] == (w * w + x * x - y * y - z * z) / norm);
      CHECK(rotation.linear[1][0] == 2 * (x * y + w * z) / norm);
      CHECK(rotation.linear[2][1] == 2 * (y * z + w * x) / norm);
    }
    CHECK(axis.rotation(2)(across) == times(-1, across));
    CHECK(axis.rotation(4)(across) == across);
    const Turn a = axis.turn_of_degrees(80);
    const Turn b = axis.turn_of_degrees(105);
    CHECK(nearest_double(axis.half_tangent_between(a, b)) * std::sqrt(nearest_double(axis.square())) ==
          Approx(std::tan(12.5 * M_PI / 180)));
    for (const int degrees : {0, 17, 100, 180, 181, 300}) {
      const Turn turn = axis.turn_of_degrees(degrees);
      const Rational3 tilted = {across[0] + direction[0], across[1] + direction[1], across[2] + direction[2]};
      CHECK(axis.turn_between(tilted, times(3, axis.rotation(turn)(tilted))) == turn);
    }
    CHECK_FALSE(axis.turn_between(across, direction).has_value());
  }
  const TurningAxis z({0, 0, 1});
  CHECK(z.turn_of_degrees(90) == 1);
  CHECK(z.turn_of_degrees(-90) == -1);
  CHECK(z.turn_between({1, 0, 0}, {-3, 4, 0}) == Turn(1) + ratio(1, 3));
  CHECK_FALSE(z.turn_between({1, 0, 0}, {1, 1, 0}).has_value());
  CHECK(z.half_tangent_between(ratio(5, 4), 2) == ratio(3, 5));
  CHECK_THROWS_AS(TurningAxis({0, 0, 0}), InputError);
}

TEST_CASE("a convex solid cut by planes, through its vertices, edges and faces as well") {
  std::mt19937 random(5);
  const auto number = [&](int low, int high) {
    return Rational(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
  };
  for (int i = 0; i < 300; ++i) {
    // A grid as coarse as this makes planes through vertices ordinary.
    std::vector<Rational3> points;
    for (int k = 0; k < 6; ++k) points.push_back({number(-2, 2), number(-2, 2), number(-2, 2)});
    if (hull_of(points).dimension < 3) continue;
    std::optional<Mesh> rest = convex_hull_mesh(points);
    Polyhedron expected = convex_hull(points);
    for (int k = 0; k < 3; ++k) {
      const Rational3 normal{number(-1, 1), number(-1, 1), number(-1, 1)};
      if (is_zero(normal)) continue;
      const Rational offset = number(-2, 3);
      expected = regularize(intersect(expected, make_halfspace(normal[0], normal[1], normal[2], -offset)));
      if (rest) rest = clipped(std::move(*rest), normal, offset);
      REQUIRE(rest.has_value() == !expected.is_empty());
      if (!rest) break;
      const Polyhedron cut = from_mesh(*rest, MeshOptions{.strict = true});  // with all its checks
      REQUIRE(equal(cut, expected));
      REQUIRE(rest->face_count() == cut.complex().facets.size());
    }
  }
}

TEST_CASE("the outer robot holds the robot at all angles, which all hold the inner one") {
  std::mt19937 random(3);
  const Polyhedron robots[] = {make_box({-1, -2, 0}, {3, 1, 1}), make_box({1, 1, -1}, {3, 2, 1}),
                               unite(make_box({-1, -1, -1}, {4, 1, 1}), make_box({-1, -1, -1}, {1, 3, 1}))};
  for (const Polyhedron& robot : robots) {
    for (const Rational3& direction : axes()) {
      const TurningRobot turning(robot, TurningAxis(direction));
      for (int i = 0; i < 2; ++i) {
        const long low = static_cast<long>(random() % 20);
        const Turn a = 1 + ratio(low, 32);
        const Turn b = a + ratio(1 + static_cast<long>(random() % 11), 32);
        const Polyhedron outer = turning.outer(a, b);
        const Polyhedron inner = turning.inner(a, b);
        CHECK(inner.is_regular());
        for (int k = 0; k <= 4; ++k) {
          const Polyhedron at = turning.at(a + ratio(k, 4) * (b - a));
          CHECK(subtract(at, outer).is_empty());
          CHECK(subtract(inner, at).is_empty());
        }
      }
    }
  }
  // Narrow ranges: nearly the robot itself.
  const TurningRobot bar(make_box({-3, -1, 0}, {3, 1, 1}), TurningAxis({0, 0, 1}));
  const Turn a = ratio(1, 3);
  const Turn b = a + ratio(1, 1000);
  CHECK(nearest_double(*volume(bar.inner(a, b))) == Approx(12).epsilon(0.01));
  CHECK(nearest_double(*volume(bar.outer(a, b))) == Approx(12).epsilon(0.01));
  const Polyhedron chords = intersect(make_halfspace(-1, 1, 0, -1), make_halfspace(1, -1, 0, -1));
  CHECK(equal(bar.inner(0, 1), intersect(make_box({-1, -1, 0}, {1, 1, 1}), chords)));
  CHECK_THROWS_AS(TurningRobot(make_box({0, 0, 0}, {1, 1, 0}), TurningAxis({0, 0, 1})), InputError);
}

// The robot in no obstacle, at poses all along every motion; one coordinate changes at a time.
void check_path(const Scene& scene, const TurningQuestion& question, const TurningAnswer& answer) {
  REQUIRE(answer.path.size() > 0);
  CHECK(answer.path.front().position == question.start.position);
  CHECK(answer.path.back().position == question.goal.position);
  const TurningRobot robot(scene.robot, question.axis);
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
      const Polyhedron body = transform(robot.at(from.turn + t * (to.turn - from.turn)), AffineMap::translate(x));
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
    const TurningAnswer answer = find_turning_path(scene, question, {.max_cells = 400, .stop = {}});
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
      const TurningRobot robot(scene.robot, question.axis);
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
        slice.robot = robot.at(ratio(t, 16));
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
  CHECK(paths >= 2);
  CHECK(proofs >= 2);
}

TEST_CASE("proofs hold when they are checked by other means, and spoilt ones do not") {
  const Scene scene = scene_of(corner("3.7"));
  const TurningQuestion question = question_of(scene);
  const TurningAnswer answer = find_turning_path(scene, question);
  REQUIRE(answer.proof.has_value());
  CHECK_FALSE(complaint_about(*answer.proof, scene, question).has_value());
  const auto complaint = [&](auto&& spoil) {
    TurningProof proof = *answer.proof;
    spoil(proof);
    return complaint_about(proof, scene, question).value_or("it holds");
  };
  using Catch::Contains;
  CHECK_THAT(complaint([](TurningProof& p) { p.breakpoints.pop_back(); }), Contains("between two breakpoints"));
  CHECK_THAT(complaint([](TurningProof& p) { p.breakpoints.back() = ratio(7, 8); }), Contains("cover the range"));
  CHECK_THAT(complaint([](TurningProof& p) { std::swap(p.breakpoints[1], p.breakpoints[2]); }),
             Contains("out of order"));
  // The last cell that the start reaches. (Cells may have the inner robot of a wider range around them.)
  std::size_t last = 0;
  for (std::size_t i = 0; i < answer.proof->cells.size(); ++i) {
    if (!answer.proof->cells[i].start_side.empty()) last = i;
  }
  REQUIRE(last > 0);
  CHECK_THAT(complaint([&](TurningProof& p) {
               p.breakpoints = {0, 1};
               p.cells = {p.cells[last]};
             }),
             Contains("does not hold its inner robot"));
  CHECK_THAT(complaint([&](TurningProof& p) {
               for (Rational3& v : p.cells[last].inner[0]) v = times(ratio(1001, 1000), v);
             }),
             Contains("does not hold its inner robot"));
  CHECK_THAT(complaint([](TurningProof& p) {
               p.breakpoints = {0, 1};
               p.cells = {TurningProof::Cell{{}, p.cells[0].start_side}};
             }),
             Contains("are not apart"));
  CHECK_THAT(complaint([](TurningProof& p) { p.cells[0].start_side.clear(); }), Contains("leaves out a component"));
  CHECK_THAT(complaint([&](TurningProof& p) {
               p.cells[last].start_side.push_back({-1, 12, 0});
             }),
             Contains("not joined to the start"));
  CHECK_THAT(complaint([](TurningProof& p) {
               p.cells[0].start_side.push_back({5, 5, 0});
             }),
             Contains("not joined to the start"));
  // Of another scene: the same bar, shorter.
  const Scene shorter = scene_of(corner("3.5"));
  CHECK(complaint_about(*answer.proof, shorter, question_of(shorter)).has_value());
  TurningQuestion wider = question;
  wider.high = 2;
  CHECK(complaint_about(*answer.proof, scene, wider).has_value());
}

TEST_CASE("proofs about robots that are not convex, forbidden contact, tilted axes, rings") {
  const std::string l_shape = "box(-1,-1,0, 1,0,1) + box(-1,-1,0, 0,2,1)";
  // A wall with a window that the robot does not pass however it is turned, and one in which it merely does not fit.
  const std::string window =
      "box(3,-9,-9, 4,9,9) - interior(box(2,-1/2,-1/2, 5,1/2,1/2)) - interior(box(2,4,-1, 5,5,5/4))";
  for (const std::string contact : {"allow", "forbid"}) {
    for (const std::string axis : {R"("z")", "[1, 1, 1]", "[0, 3, 4]"}) {
      INFO(contact << ' ' << axis);
      const Scene scene = scene_of(R"J({"robot": ")J" + l_shape + R"J(", "obstacles": [")J" + window +
                                   R"J("], "box": [[-1,-3,-3],[8,3,3]], "start": [0,0,0,0], "goal": [7,0,0,0],
                                   "rotation": {"axis": )J" +
                                   axis + R"J(}, "contact": ")J" + contact + R"J("})J");
      const TurningQuestion question = question_of(scene);
      const TurningAnswer answer = find_turning_path(scene, question, {.max_cells = 60, .stop = {}});
      REQUIRE(answer.status == TurningAnswer::Status::kInfeasible);
      CHECK(complaint_about(*answer.proof, scene, question).value_or("it holds") == "it holds");
    }
  }
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
