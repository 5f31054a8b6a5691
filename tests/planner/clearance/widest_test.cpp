// SPDX-License-Identifier: Apache-2.0
//
// How much larger a robot may be, against sizes known in closed form; distances kept, measured; times.
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/planner/clearance/timing.h"
#include "apps/planner/clearance/widest.h"
#include "apps/planner/clearance/widest_robot.h"
#include "apps/planner/path/path.h"
#include "apps/planner/path/question.h"
#include "apps/program/reports/exact_json.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/distance/distance.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

TEST_CASE("lists with time stamps have one line for each time") {
  using Numbers = std::vector<std::size_t>;
  CHECK(distinct_times({0}) == Numbers{0});
  CHECK(distinct_times({0, 1, 2}) == Numbers{0, 1, 2});
  CHECK(distinct_times({0, 0, 1, 1, 2, 2}) == Numbers{0, 2, 5});
  CHECK(distinct_times({0, 0}) == Numbers{0});
  // A turn of next to nothing after a long way.
  const std::vector<double> times = times_of({1e6, 1e-13, 1}, {.speed = 1});
  CHECK(distinct_times(times) == Numbers{0, 1, 3});
}

const Rational kLeast = ratio(1, 1 << 20);

TEST_CASE("bisection: simple critical sizes are met, others are between, what is undecided is said") {
  for (const Rational& critical : {ratio(3, 2), ratio(1, 7), ratio(100, 3), Rational(1)}) {
    const Widest found = find_widest(1, kLeast, ratio(1, 1000), [&](const Rational& size) {
      return size <= critical ? Verdict::kPath : Verdict::kNone;
    });
    REQUIRE(found.low);
    REQUIRE(found.high);
    CHECK(*found.low == critical);
    CHECK(*found.high > critical);
    CHECK(*found.high - *found.low <= ratio(1, 1000) * *found.high);
  }
  const Widest root = find_widest(1, kLeast, ratio(1, 1000000), [](const Rational& size) {
    return size * size <= 2 ? Verdict::kPath : Verdict::kNone;
  });
  CHECK(*root.low * *root.low < 2);
  CHECK(*root.high * *root.high > 2);
  CHECK(*root.high - *root.low <= ratio(2, 1000000));
  const Widest never = find_widest(1, kLeast, ratio(1, 10), [](const Rational&) { return Verdict::kNone; });
  CHECK_FALSE(never.low);
  CHECK(never.high == kLeast);
  const Widest always = find_widest(0, kLeast, ratio(1, 10), [](const Rational&) { return Verdict::kPath; });
  CHECK_FALSE(always.high);
  CHECK(always.low);
  const Widest open = find_widest(1, kLeast, ratio(1, 10), [](const Rational& size) {
    return size < 1 ? Verdict::kPath : size > 1 ? Verdict::kNone : Verdict::kUndecided;
  });
  CHECK(open.undecided);
  // Nothing is close to 0 by its own measure.
  const Widest none = find_widest(0, kLeast, ratio(1, 1000),
                                  [](const Rational& size) { return size == 0 ? Verdict::kPath : Verdict::kNone; });
  CHECK(none.low == 0);
  CHECK(*none.high <= kLeast);
  CHECK(none.questions < 25);
  const Widest refused = find_widest(0, kLeast, ratio(1, 1000), [](const Rational&) { return Verdict::kNone; });
  CHECK_FALSE(refused.low);
  CHECK(refused.questions == 1);
}

TEST_CASE("a polytope around a ball") {
  const Polyhedron around = around_ball(ratio(3, 2));
  CHECK(around.complex().facet_count() == 30);
  const Polyhedron outside = complement(interior(around));
  CHECK(distance(make_point({0, 0, 0}), outside)->squared == ratio(9, 4));
  const Complex& c = around.complex();
  double farthest = 0;
  for (const VertexId v : c.vertex_ids()) {
    farthest = std::max(farthest, distance(c.points.rational(point_of(v)), Rational3{}));
  }
  CHECK(farthest <= 1.2 * 1.5);
}

// A wall with a gap from y = 0 to 3/2, for robots of height 1 on a floor that is free.
const char* const kGap = R"J({"robot": "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "start": [0,0,0], "goal": [9,0,0],
  "obstacles": ["box(4,-9,-9, 5,-3/4,9)", "box(4,3/4,-9, 5,9,9)"], "box": [[-1,-5,-1],[10,5,1]])J";

Scene gap(const std::string& more = "}") { return parse_scene(kGap + more, "", "gap"); }

TEST_CASE("paths that keep clear do") {
  for (const auto& [clear, fits] :
       {std::pair(ratio(1, 5), true), std::pair(ratio(1, 4), true), std::pair(ratio(26, 100), false)}) {
    Scene scene = gap();
    const Scene plain = scene;
    keep_clear(scene, clear);
    CHECK(scene.messages.size() == 1);
    const Answer answer = Problem(scene).solve();
    CHECK((answer.status == Answer::Status::kPath) == fits);
    if (!answer.path) continue;
    const std::vector<Rational3>& points = answer.path->points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      for (int k = 0; k <= 4; ++k) {
        Rational3 at = points[i];
        for (std::size_t x = 0; x < 3; ++x) at[x] += ratio(k, 4) * (points[i + 1][x] - at[x]);
        const Polyhedron robot = transform(plain.robot, AffineMap::translate(at));
        for (const Polyhedron& obstacle : plain.obstacles) {
          CHECK(distance(robot, obstacle)->squared >= clear * clear);
        }
      }
    }
  }
  Scene scene = gap();
  CHECK_THROWS_AS(keep_clear(scene, 0), InputError);
}

TEST_CASE("a robot that fits exactly may not be larger") {
  for (const char* robot : {"box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "box(-1/5000,-1/2,-1/2, 1/5000,1/2,1/2)"}) {
    Scene scene = parse_scene(R"J({"robot": ")J" + std::string(robot) + R"J(", "start": [0,0,0], "goal": [9,0,0],
      "obstacles": ["box(4,-9,-9, 5,-1/2,9)", "box(4,1/2,-9, 5,9,9)"], "box": [[-1,-5,-1],[10,5,1]]})J",
                              "", "fits");
    const Polyhedron as_it_is = scene.robot;
    const Widest found = widest_robot(scene, Growth::kBox);
    CHECK(found.low == 0);
    CHECK(*found.high <= ratio(1, 1 << 20));
    CHECK(equal(scene.robot, as_it_is));
  }
  // A point at a wall, which has no extent.
  Scene scene = parse_scene(R"J({"robot": "point(0,0,0)", "start": [0,0,0], "goal": [9,0,0],
    "obstacles": ["box(-1,-9,-9, 0,9,9)"], "box": [[-2,-5,-1],[10,5,1]]})J",
                            "", "point");
  const Widest found = widest_robot(scene, Growth::kBox);
  CHECK(found.low == 0);
  CHECK(*found.high <= ratio(9, 1 << 20));
}

TEST_CASE("robots grow by factors only where smaller is easier") {
  const Polyhedron bar = make_box({-1, -1, -1}, {3, 1, 1});
  CHECK(equal(grown(bar, Growth::kScale, 2), make_box({-2, -2, -2}, {6, 2, 2})));
  CHECK(equal(grown(bar, Growth::kBox, ratio(1, 2)),
              make_box({ratio(-3, 2), ratio(-3, 2), ratio(-3, 2)}, {ratio(7, 2), ratio(3, 2), ratio(3, 2)})));
  CHECK(equal(grown(bar, Growth::kBox, 0), bar));
  CHECK_NOTHROW(grown(make_box({0, 0, 0}, {1, 1, 1}), Growth::kScale, 2));
  CHECK_THROWS_AS(grown(make_box({1, 1, 1}, {2, 2, 2}), Growth::kScale, 2), InputError);
  const Polyhedron u_shape = subtract(make_box({-3, -3, 0}, {3, 3, 1}), interior(make_box({-2, -2, -1}, {2, 4, 2})));
  CHECK_THROWS_AS(grown(u_shape, Growth::kScale, 2), InputError);
}

TEST_CASE("times: from rest to rest") {
  CHECK(seconds_for(6, {.speed = 2, .acceleration = 0}) == Approx(3));
  CHECK(seconds_for(6, {.speed = 2, .acceleration = 1}) == Approx(5));  // 2 s up, 2 m at full speed, 2 s down
  CHECK(seconds_for(1, {.speed = 2, .acceleration = 1}) == Approx(2));  // never at full speed
  CHECK(seconds_for(0, {.speed = 2, .acceleration = 1}) == Approx(0));
  CHECK(times_of({6, 1}, {.speed = 2, .acceleration = 1}) == std::vector<double>{0, 5, 7});
  // An integral of the speed gives the length back.
  for (const double length : {0.3, 2.0, 7.0}) {
    const MotionLimits limits{.speed = 1.5, .acceleration = 0.8};
    const double end = seconds_for(length, limits);
    double way = 0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
      const double t = (i + 0.5) * end / kSteps;
      way += std::min({limits.speed, limits.acceleration * t, limits.acceleration * (end - t)}) * end / kSteps;
    }
    CHECK(way == Approx(length).epsilon(1e-6));
  }
}

TEST_CASE("widest robots and time stamps on the command line") {
  const Folder folder;
  const std::string scene = folder.write("gap.json", std::string(kGap) + "}");
  const auto report = [&](const std::string& arguments, int code = 0) {
    const Run run = planner(folder, arguments + " --json");
    CHECK(run.code == code);
    return nlohmann::json::parse(run.out);
  };
  const auto scaled = report(scene + " --widest");
  CHECK(scaled["widest"]["low"] == "3/2");
  CHECK(scaled["widest"]["high_double"].get<double>() == Approx(1.5).epsilon(0.001));
  CHECK(scaled["status"] == "path");
  const auto boxed = report(scene + " --widest-box --precision 1/100");
  CHECK(boxed["widest"]["low"] == "1/4");
  CHECK(boxed["widest"]["growth"] == "box");
  // Half as wide a gap: only smaller ones pass.
  const std::string narrow = folder.write("narrow.json", R"J({"robot": "box(-1,-1,-1, 1,1,1)", "start": [0,0,0],
    "goal": [9,0,0], "obstacles": ["box(4,-9,-9, 5,-1/3,9)", "box(4,1/3,-9, 5,9,9)"], "box": [[-1,-5,-1],[10,5,1]]})J");
  CHECK(report(narrow + " --widest")["widest"]["low"] == "1/3");
  CHECK_FALSE(report(narrow + " --widest-box", 1)["widest"].contains("low"));
  // A bar of 3.5 s by s round the corner of a corridor of width 2: 3.5 s / 2 + s <= 2 sqrt(2).
  const std::string corner = folder.write("corner.json", R"J({"robot": "box(-7/4,-1/2,0, 7/4,1/2,1)",
    "rotation": {"range": [0, 90]}, "start": [-12,-1,0, 0], "goal": [-1,12,0, 90], "box": [[-15,-15,0],[15,15,0]],
    "obstacles": ["box(-20,-20,-1, 20,20,2) - interior(box(-20,-2,-2, 0,0,3)) - interior(box(-2,-2,-2, 0,20,3))"]})J");
  const auto turning = report(corner + " --widest --precision 1/20");
  const double limit = 2 * std::sqrt(2.0) / 2.75;
  CHECK(turning["widest"]["low_double"].get<double>() < limit);
  CHECK(turning["widest"]["high_double"].get<double>() > limit);
  CHECK(turning["widest"]["high_double"].get<double>() < limit * 1.06);

  const Run clear = planner(folder, scene + " --keep-clear 1/4 --speed 2 --acceleration 4 -o " + folder.file("p.csv"));
  CHECK(clear.code == 0);
  CHECK_THAT(clear.err, Catch::Contains("keep at least this distance"));
  CHECK_THAT(text_of(folder.file("p.csv")), Catch::StartsWith("t,x,y,z\n0,0,0,0\n"));
  CHECK(planner(folder, scene + " --keep-clear 0.3").code == 1);
  const auto timed = report(scene + " --speed 3");
  CHECK(timed["times_s"].back().get<double>() == Approx(3));
  CHECK(timed["times_s"].size() == timed["path"].size());
  const Run way = planner(folder, corner + " --speed 1 -o " + folder.file("t.csv"));
  CHECK(way.code == 0);
  CHECK_THAT(text_of(folder.file("t.csv")), Catch::StartsWith("t,x,y,z,degrees\n0,-12,-1,0,0\n"));
  for (const char* bad : {" --widest --widest-box", " --widest --tight", " --acceleration 2", " -o x.csv",
                          " --widest --precision 0", " --keep-clear -1", " --speed -1"}) {
    CHECK(planner(folder, scene + bad).code == 2);
  }
}

}  // namespace
}  // namespace nef::planner::test
