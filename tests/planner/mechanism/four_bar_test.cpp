// SPDX-License-Identifier: Apache-2.0
//
// Four-bar linkages: angles known in closed form, and Booleans of the moved part at many angles, placed by the law of
// cosines in doubles.
#include "apps/planner/mechanism/four_bar.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "apps/planner/mechanism/range_of_motion.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::four_bar {
namespace {

Mechanism mechanism(const std::string& text) { return parse_mechanism(text, "", "test"); }

double degrees(const RangeEnd& end, const Mechanism& m) { return m.joint.measure_of(end.value.rational); }

TEST_CASE("a parallelogram moves its coupler along a circle", "[mechanism]") {
  // Both cranks stand upright at 0; at -30 degrees the coupler has gone half a unit to the right and reaches the wall.
  const std::string text = R"J({"moving": "box(0,1,0, 4,3/2,1)", "fixed": ["box(9/2,-3,0, 6,3,1)"],
      "joint": {"type": "four-bar", "axis": "z", "pivots": [[0,0,0], [4,0,7]], "pins": [[0,1,-5], [4,1,0]],
      "moves": "coupler", "range": [-80, 80]}})J";
  const Mechanism m = mechanism(text);
  const RangeOfMotion range = nef::planner::range_of_motion(m);
  REQUIRE(range.parts.size() == 3);
  CHECK(range.parts[0].status == RangeStatus::kColliding);
  CHECK(range.parts[1].status == RangeStatus::kUndecided);
  CHECK(range.parts[2].status == RangeStatus::kFree);
  CHECK(degrees(range.parts[1].from, m) <= -30);
  CHECK(degrees(range.parts[1].to, m) >= -30);
  CHECK(degrees(range.parts[1].to, m) - degrees(range.parts[1].from, m) < 1e-5);
  // Its rocker turns as the crank does.
  std::string rocker = text;
  rocker.replace(rocker.find("\"coupler\""), 9, "\"rocker\"");
  rocker.replace(rocker.find("box(0,1,0, 4,3/2,1)"), 19, "box(4,0,0, 17/4,1,1)");
  rocker.replace(rocker.find("box(9/2,-3,0, 6,3,1)"), 20, "box(5,-3,0, 6,3,1)");
  const Mechanism turning = mechanism(rocker);
  const RangeOfMotion turns = nef::planner::range_of_motion(turning);
  REQUIRE(turns.parts.size() == 3);
  // Its corner (1/4, 1) from the pivot comes to x = 1.
  const double expected = -(std::acos(1 / std::hypot(0.25, 1.0)) * -1 + std::atan2(1, 0.25)) * 180 / M_PI;
  CHECK(turns.parts[1].status == RangeStatus::kUndecided);
  CHECK(degrees(turns.parts[1].from, turning) <= expected);
  CHECK(degrees(turns.parts[1].to, turning) >= expected);
  CHECK(degrees(turns.parts[1].to, turning) - degrees(turns.parts[1].from, turning) < 1e-3);
}

TEST_CASE("what a linkage slides on is touched all the time", "[mechanism]") {
  const std::string joint =
      R"J("joint": {"type": "four-bar", "axis": [0, 0, 2], "pivots": [[0,0,0], [4,0,0]], "pins": [[0,1,0], [4,1,0]],
      "moves": "coupler", "range": [-60, 60]}})J";
  // A plate below all of it, and one that it leaves at 30 degrees, when it has gone half a unit to the left.
  const RangeOfMotion below = nef::planner::range_of_motion(
      mechanism(R"J({"moving": "box(0,1,0, 4,3/2,1)", "fixed": ["box(-9,-9,-1, 9,9,0)"], )J" + joint));
  REQUIRE(below.parts.size() == 1);
  CHECK(below.parts[0].status == RangeStatus::kTouching);
  const Mechanism m = mechanism(
      R"J({"moving": "box(0,1,0, 4,3/2,1)", "fixed": ["box(7/2,-9,1, 9,9,2)", "box(20,0,0, 21,1,1)"], )J" + joint);
  const RangeOfMotion beside = nef::planner::range_of_motion(m);
  REQUIRE(beside.parts.size() == 3);
  CHECK(beside.parts[0].status == RangeStatus::kTouching);
  CHECK(beside.parts[1].status == RangeStatus::kUndecided);
  CHECK(degrees(beside.parts[1].from, m) <= 30);
  CHECK(degrees(beside.parts[1].to, m) >= 30);
  CHECK(beside.parts[2].status == RangeStatus::kFree);
}

TEST_CASE("a linkage that does not close in all of its range is refused", "[mechanism]") {
  const auto refused = [](const std::string& joint) {
    try {
      static_cast<void>(nef::planner::range_of_motion(mechanism(
          R"J({"moving": "box(0,0,0, 1,1,1)", "fixed": ["box(9,9,0, 10,10,1)"], "joint": {"type": "four-bar", )J" +
          joint + "}}")));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  const std::string parallelogram =
      R"J("axis": "z", "pivots": [[0,0,0], [4,0,0]], "pins": [[0,1,0], [4,1,0]], "moves": "coupler", )J";
  CHECK(refused(parallelogram + R"J("range": [-89, 89])J") == "taken");
  CHECK_THAT(refused(parallelogram + R"J("range": [0, 180])J"), Catch::Contains("when the crank is at 89.99"));
  CHECK_THAT(refused(parallelogram + R"J("range": [100, 20])J"), Catch::Contains("range"));
  CHECK_THAT(refused(R"J("axis": "z", "pivots": [[0,0,0], [4,0,0]], "pins": [[0,1,0], [9,1,0]], "moves": "crank",
      "range": [0, 10])J"),
             Catch::Contains("moves"));
  CHECK_THAT(refused(R"J("axis": "z", "pivots": [[0,0,0], [4,0,0]], "pins": [[0,0,5], [9,1,0]], "moves": "rocker",
      "range": [0, 10])J"),
             Catch::Contains("no length"));
  CHECK_THAT(refused(R"J("axis": "z", "pivots": [[0,0,0], [4,0,0]], "pins": [[1,0,0], [2,0,0]], "moves": "rocker",
      "range": [0, 10])J"),
             Catch::Contains("one line"));
}

// Where a link is, in doubles.
struct Numbers {
  using Point = std::array<double, 2>;
  Point rocker_pivot, crank_pin, rocker_pin;  // from the crank's pivot
  bool moves_rocker = false;

  // How far from being stretched or folded.
  double spare = 1;

  // The turn and the shift of the link.
  std::array<double, 4> place(double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const Point pin{c * crank_pin[0] - s * crank_pin[1], s * crank_pin[0] + c * crank_pin[1]};
    const auto between = [](const Point& a, const Point& b) { return Point{b[0] - a[0], b[1] - a[1]}; };
    const auto length = [](const Point& a) { return std::hypot(a[0], a[1]); };
    const auto turn = [](const Point& a, const Point& b) {
      return std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    };
    const Point coupler = between(crank_pin, rocker_pin);
    const Point rocker = between(rocker_pivot, rocker_pin);
    const Point way = between(pin, rocker_pivot);
    const double far = length(way);
    const double cosine =
        (length(coupler) * length(coupler) + far * far - length(rocker) * length(rocker)) / (2 * length(coupler) * far);
    spare = 1 - std::fabs(cosine);
    const double inner = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double side = turn(between(crank_pin, rocker_pivot), coupler) > 0 ? 1 : -1;
    const double direction = std::atan2(way[1], way[0]) + side * inner;
    const Point there{pin[0] + length(coupler) * std::cos(direction), pin[1] + length(coupler) * std::sin(direction)};
    const double by = moves_rocker ? turn(rocker, between(rocker_pivot, there)) : turn(coupler, between(pin, there));
    const Point& from = moves_rocker ? rocker_pivot : crank_pin;
    const Point& to = moves_rocker ? rocker_pivot : pin;
    return {std::cos(by), std::sin(by), to[0] - std::cos(by) * from[0] + std::sin(by) * from[1],
            to[1] - std::sin(by) * from[0] - std::cos(by) * from[1]};
  }
};

TEST_CASE("random four-bar linkages against Booleans of the moved part", "[mechanism]") {
  std::mt19937 random(39);
  const auto upto = [&](int n) { return static_cast<long>(random() % static_cast<unsigned>(n)); };
  std::array<unsigned, 3> seen{};
  unsigned refused = 0;
  for (unsigned round = 0; round < seeds(24); ++round) {
    INFO("round " << round);
    const auto number = [&](int low, int high) { return ratio(2 * low + upto(2 * (high - low) + 1), 2); };
    const Rational3 crank_pivot{number(-2, 2), number(-2, 2), 0};
    const Rational3 rocker_pivot{crank_pivot[0] + number(3, 5), crank_pivot[1] + number(-1, 1), 1};
    const Rational3 crank_pin{crank_pivot[0] + number(-1, 1), crank_pivot[1] + ratio(1, 2), 0};
    const Rational3 rocker_pin{rocker_pivot[0] + number(-1, 2), rocker_pivot[1] + number(2, 4), 0};
    Mechanism m;
    m.name = "random";
    const Rational3 low{number(-2, 3), number(-2, 3), 0};
    m.moving = make_box(low, {low[0] + number(1, 3), low[1] + 1, 1});
    for (int k = 0; k < 2; ++k) {
      const Rational3 at{number(-6, 6), number(-6, 6), ratio(-upto(3), 4)};
      m.fixed.push_back(make_box(at, {at[0] + number(1, 3), at[1] + number(1, 3), at[2] + 1}));
      m.fixed_names.emplace_back("fixed");
    }
    Numbers numbers;
    const auto seen_from_pivot = [&](const Rational3& p) {
      return Numbers::Point{nearest_double(p[0] - crank_pivot[0]), nearest_double(p[1] - crank_pivot[1])};
    };
    numbers.rocker_pivot = seen_from_pivot(rocker_pivot);
    numbers.crank_pin = seen_from_pivot(crank_pin);
    numbers.rocker_pin = seen_from_pivot(rocker_pin);
    numbers.moves_rocker = upto(2) == 0;
    m.low = 0;
    m.high = ratio(upto(8) + 1, 2);
    RangeOfMotion range;
    try {
      m.joint = Joint::four_bar({0, 0, 3}, {crank_pivot, rocker_pivot}, {crank_pin, rocker_pin},
                                numbers.moves_rocker ? FourBar::Link::kRocker : FourBar::Link::kCoupler);
      range = nef::planner::range_of_motion(m);
    } catch (const InputError&) {
      ++refused;
      // Somewhere the bars are nearly in one line.
      double least = 1;
      for (int k = 0; k <= 400; ++k) {
        static_cast<void>(numbers.place(nearest_double(m.high) * M_PI / 2 * k / 400));
        least = std::min(least, numbers.spare);
      }
      CHECK(least < 0.02);
      continue;
    }
    for (int k = 0; k <= 24; ++k) {
      const Rational value = ratio(k, 24) * m.high;
      const auto [c, s, x, y] = numbers.place(m.joint.measure_of(value) * M_PI / 180);
      AffineMap map = AffineMap::identity();
      map.linear[0] = {exact_rational(c), exact_rational(-s), 0};
      map.linear[1] = {exact_rational(s), exact_rational(c), 0};
      map.translation = {exact_rational(x), exact_rational(y), 0};
      const AffineMap to = AffineMap::translate(crank_pivot);
      const AffineMap from = AffineMap::translate({-crank_pivot[0], -crank_pivot[1], 0});
      const Polyhedron moved = transform(m.moving, to.after(map).after(from));
      RangeStatus truth = RangeStatus::kFree;
      for (const Polyhedron& fixed : m.fixed) {
        if (!intersect(interior(moved), interior(fixed)).is_empty()) truth = RangeStatus::kColliding;
      }
      for (const RangePart& part : range.parts) {
        const bool is_inside = compare(part.from.value, value) < 0 && compare(part.to.value, value) > 0;
        if (!is_inside || part.status == RangeStatus::kUndecided) continue;
        INFO("value " << to_string(value));
        CHECK(static_cast<int>(part.status) == static_cast<int>(truth));
        ++seen[static_cast<std::size_t>(truth)];
      }
    }
  }
  CHECK(seen[static_cast<std::size_t>(RangeStatus::kFree)] > 0);
  CHECK(seen[static_cast<std::size_t>(RangeStatus::kColliding)] > 0);
  INFO(refused);
}

}  // namespace
}  // namespace nef::planner::test::four_bar
