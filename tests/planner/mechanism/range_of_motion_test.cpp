// SPDX-License-Identifier: Apache-2.0
//
// Ranges of motion against angles known in closed form, and against Booleans of the moved part at many values.
#include "apps/planner/mechanism/range_of_motion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/planner/mechanism/contact_events.h"
#include "apps/planner/rigid/motion_checker.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/report_shape.h"
#include "tests/support/shapes/ball.h"

namespace nef::planner::test::range_of_motion {
namespace {

Mechanism mechanism(const std::string& text) { return parse_mechanism(text, "", "test"); }

// By definition, with sets.
RangeStatus true_status(const Mechanism& m, const RigidPose& pose) {
  const Rational3& c = m.joint.point();
  const AffineMap to = AffineMap::translate(c);
  const AffineMap from = AffineMap::translate({-c[0], -c[1], -c[2]});
  const AffineMap turn{rotation_between(pose.quaternion, pose.quaternion), pose.position};
  const Polyhedron moved = transform(m.moving, to.after(turn).after(from));
  RangeStatus status = RangeStatus::kFree;
  for (const Polyhedron& fixed : m.fixed) {
    if (intersect(moved, fixed).is_empty()) continue;
    status = RangeStatus::kTouching;
    if (!intersect(interior(moved), interior(fixed)).is_empty()) return RangeStatus::kColliding;
  }
  return status;
}

// The status that the range says for a value.
RangeStatus told_status(const RangeOfMotion& range, const Rational& value) {
  const RangePart* open = nullptr;
  for (const RangePart& part : range.parts) {
    const int from = compare(part.from.value, value);
    const int to = compare(part.to.value, value);
    const bool closed = part.status == RangeStatus::kTouching;
    if (from < 0 && to > 0) return part.status;
    if (from <= 0 && to >= 0) {
      if (closed) return part.status;
      open = &part;
    }
  }
  REQUIRE(open != nullptr);
  return open->status;
}

// Parts cover the range, one after the other.
void check_cover(const RangeOfMotion& range, const Mechanism& m) {
  REQUIRE_FALSE(range.parts.empty());
  CHECK(compare(range.parts.front().from.value, m.low) == 0);
  CHECK(compare(range.parts.back().to.value, m.high) == 0);
  for (std::size_t i = 0; i + 1 < range.parts.size(); ++i) {
    CHECK(compare(range.parts[i].to.value, range.parts[i + 1].from.value) == 0);
    CHECK(range.parts[i].status != range.parts[i + 1].status);
    // What is free does not become colliding without touching; what holds there is not always known of screws.
    const auto is_between = [&](const RangePart& part) {
      return part.status == RangeStatus::kTouching ||
             (m.joint.kind() == Joint::Kind::kScrew && part.status == RangeStatus::kUndecided);
    };
    CHECK((is_between(range.parts[i]) || is_between(range.parts[i + 1])));
  }
}

double degrees(const RangeEnd& end, const Mechanism& m) { return m.joint.measure_of(enclosure(end.value, 60)[0]); }

TEST_CASE("a door between two blocks: its angles in closed form, and what stops it", "[mechanism]") {
  const Mechanism m = mechanism(R"J({"moving": "box(0,0,0, 3,1/5,2)", "fixed": ["box(2,1,0, 3,2,1)",
      "box(-1,-2,0, 0,-1/2,2)"], "joint": {"type": "hinge", "axis": "z"}})J");
  const RangeOfMotion range = nef::planner::range_of_motion(m);
  check_cover(range, m);
  REQUIRE(range.parts.size() == 9);
  // The corner (3, 1/5) comes to y = 1; the lower side passes (2, 2) at 45 degrees.
  const double first = (std::asin(1 / std::hypot(3, 0.2)) - std::atan2(0.2, 3)) * 180 / M_PI;
  CHECK(degrees(range.parts[1].from, m) == Approx(first).margin(1e-12));
  CHECK(degrees(range.parts[3].from, m) == Approx(45).margin(1e-12));
  CHECK_FALSE(range.parts[3].from.value.is_rational());
  // The second block: the upper side passes (0, -1/2)... by its own corner, and is left at 270 degrees.
  CHECK(range.parts[7].from.value.is_rational());
  CHECK(range.parts[7].from.value.rational == 3);
  const RangeStatus expected[] = {RangeStatus::kFree,      RangeStatus::kTouching, RangeStatus::kColliding,
                                  RangeStatus::kTouching,  RangeStatus::kFree,     RangeStatus::kTouching,
                                  RangeStatus::kColliding, RangeStatus::kTouching, RangeStatus::kFree};
  for (std::size_t i = 0; i < 9; ++i) CHECK(range.parts[i].status == expected[i]);
  for (const std::size_t i : {1U, 3U, 5U, 7U}) CHECK_FALSE(range.parts[i].from.stops.empty());
  // The corner meets the front face of the first block.
  CHECK(range.parts[1].from.stops.front().moving.substr(0, 6) == "vertex");
  CHECK(range.parts[1].from.stops.front().of_fixed.substr(0, 5) == "facet");
  CHECK(range.parts[1].from.stops.front().fixed == 0);
  CHECK(range.parts[5].from.stops.front().fixed == 1);
}

TEST_CASE("a drawer: strokes that touch along the way, and exact ends", "[mechanism]") {
  const Mechanism m =
      mechanism(R"J({"moving": "box(0,0,0, 1,1,1)", "fixed": ["box(3,1,0, 4,2,1)", "box(6,0,0, 7,1/3,1)"],
      "joint": {"type": "slider", "direction": [1, 0, 0], "range": [0, 10]}})J");
  const RangeOfMotion range = nef::planner::range_of_motion(m);
  check_cover(range, m);
  std::vector<Rational> ends;
  for (const RangePart& part : range.parts) {
    REQUIRE(part.to.value.is_rational());
    ends.push_back(part.to.value.rational);
  }
  CHECK(ends == std::vector<Rational>{2, 4, 5, 5, 7, 7, 10});
  CHECK(range.parts[1].status == RangeStatus::kTouching);
  CHECK(range.parts[4].status == RangeStatus::kColliding);
}

TEST_CASE("a corner that grazes a wall touches at one angle, and a key fits its slot at one angle", "[mechanism]") {
  // The corner (3, 4) is at distance 5, as the wall is.
  const Mechanism grazing = mechanism(R"J({"moving": "box(0,0,0, 3,4,1)", "fixed": ["box(-9,5,0, 9,6,1)"],
      "joint": {"type": "hinge", "axis": "z"}})J");
  const RangeOfMotion grazes = nef::planner::range_of_motion(grazing);
  check_cover(grazes, grazing);
  REQUIRE(grazes.parts.size() == 3);
  CHECK(grazes.parts[1].status == RangeStatus::kTouching);
  CHECK(degrees(grazes.parts[1].from, grazing) == Approx(std::atan2(3, 4) * 180 / M_PI).margin(1e-12));
  // A bar as wide as the slot it stands in, about the middle: free nowhere, touching at 0, 180 and 360 only.
  const Mechanism key = mechanism(R"J({"moving": "box(-2,-1/2,0, 2,1/2,1)", "fixed": ["box(-3,1/2,0, 3,2,1)",
      "box(-3,-2,0, 3,-1/2,1)"], "joint": {"type": "hinge", "axis": "z"}})J");
  const RangeOfMotion fits = nef::planner::range_of_motion(key);
  check_cover(fits, key);
  std::vector<double> touching;
  for (const RangePart& part : fits.parts) {
    CHECK(part.status != RangeStatus::kFree);
    if (part.status != RangeStatus::kTouching) continue;
    CHECK(compare(part.from.value, part.to.value) == 0);
    touching.push_back(degrees(part.from, key));
  }
  CHECK(touching == std::vector<double>{0, 180, 360});
}

TEST_CASE("a hinge whose cable winds up has values beyond a full turn", "[mechanism]") {
  const Mechanism key = mechanism(R"J({"moving": "box(-2,-1/2,0, 2,1/2,1)", "fixed": ["box(-3,1/2,0, 3,2,1)",
      "box(-3,-2,0, 3,-1/2,1)"], "joint": {"type": "hinge", "axis": "z", "range": [-360, 720]}})J");
  const RangeOfMotion range = nef::planner::range_of_motion(key);
  check_cover(range, key);
  std::vector<double> touching;
  for (const RangePart& part : range.parts) {
    if (part.status == RangeStatus::kTouching) touching.push_back(degrees(part.from, key));
  }
  CHECK(touching == std::vector<double>{-360, -180, 0, 180, 360, 540, 720});
}

TEST_CASE("balls of a hundred faces: pole on pole, and each other's way", "[mechanism]") {
  const auto ball_at = [](const Rational3& at) {
    return transform(nef::test::ball(1, 12, 6), AffineMap::translate(at));
  };
  Mechanism m;
  m.name = "balls";
  m.moving = ball_at({3, 0, 0});
  // The poles touch at the quarter; at three quarters the two overlap.
  m.fixed = {ball_at({0, 3, 2}), ball_at({0, -3, 0})};
  m.fixed_names = {"above", "beside"};
  m.joint = Joint::hinge({0, 0, 1}, {0, 0, 0});
  m.low = 0;
  m.high = 4;
  const RangeOfMotion range = nef::planner::range_of_motion(m);
  check_cover(range, m);
  REQUIRE(range.parts.size() == 7);
  CHECK(range.parts[1].status == RangeStatus::kTouching);
  CHECK(compare(range.parts[1].from.value, Rational(1)) == 0);
  CHECK(compare(range.parts[1].to.value, Rational(1)) == 0);
  CHECK(range.parts[1].from.stops.front().fixed == 0);
  CHECK(range.parts[4].status == RangeStatus::kColliding);
  for (const std::size_t i : {3U, 5U}) {
    CHECK(range.parts[i].from.stops.front().fixed == 1);
    for (const Rational& near : enclosure(range.parts[i].from.value, 40)) {
      CHECK(static_cast<int>(told_status(range, near)) == static_cast<int>(true_status(m, m.joint.pose(near))));
    }
  }
}

TEST_CASE("a lid that slides on its box while it turns touches at all angles", "[mechanism]") {
  const Mechanism m = mechanism(R"J({"moving": "box(-2,-1,1, 2,1,2)", "fixed": ["box(-3,-3,0, 3,3,1)"],
      "joint": {"type": "hinge", "axis": "z", "point": [1, 0, 0], "range": [-90, 90]}})J");
  const RangeOfMotion range = nef::planner::range_of_motion(m);
  REQUIRE(range.parts.size() == 1);
  CHECK(range.parts[0].status == RangeStatus::kTouching);
}

TEST_CASE("random mechanisms against Booleans at many values", "[mechanism]") {
  std::mt19937 random(380);
  const auto upto = [&](int n) { return static_cast<long>(random() % static_cast<unsigned>(n)); };
  const auto point = [&](int spread) {
    return Rational3{ratio(upto(2 * spread + 1) - spread, 2), ratio(upto(2 * spread + 1) - spread, 2),
                     ratio(upto(2 * spread + 1) - spread, 2)};
  };
  const auto solid = [&](const Rational3& at) {
    if (upto(2) == 0) {
      std::vector<Rational3> points;
      for (int i = 0; i < 6; ++i) {
        Rational3 p = point(3);
        for (std::size_t k = 0; k < 3; ++k) p[k] += at[k];
        points.push_back(p);
      }
      Polyhedron hull = convex_hull(points);
      if (hull.is_regular() && !hull.is_empty()) return hull;
    }
    const Polyhedron big = make_box(at, {at[0] + 2, at[1] + 1 + upto(2), at[2] + 2});
    const Polyhedron small = make_box({at[0] + 1, at[1], at[2] + 1}, {at[0] + 2, at[1] + 1, at[2] + 2});
    return upto(2) == 0 ? big : regularize(subtract(big, small));
  };
  std::array<unsigned, 3> seen{};
  for (unsigned i = 0; i < seeds(10); ++i) {
    Mechanism m;
    m.name = "random";
    m.moving = solid(point(2));
    for (int k = 0; k < 2; ++k) {
      m.fixed.push_back(solid(point(8)));
      m.fixed_names.push_back("fixed");
    }
    const std::vector<Rational3> axes{{0, 0, 1}, {1, 2, 2}, {1, 1, 0}, {0, 1, 0}};
    const bool slides = i % 3 == 2;
    m.joint = slides ? Joint::slider({1, ratio(upto(3), 2), 0})
                     : Joint::hinge(axes[static_cast<std::size_t>(upto(4))], point(1));
    m.low = slides ? Rational(-8) : Rational(0);
    m.high = slides ? Rational(8) : Rational(4);
    INFO("case " << i);
    const RangeOfMotion range = nef::planner::range_of_motion(m);
    check_cover(range, m);
    const auto compare_at = [&](const Rational& value) {
      const RangeStatus truth = true_status(m, m.joint.pose(value));
      ++seen[static_cast<std::size_t>(truth)];
      INFO("value " << to_string(value));
      CHECK(static_cast<int>(told_status(range, value)) == static_cast<int>(truth));
    };
    for (int k = 0; k <= 16; ++k) compare_at(m.low + ratio(k, 16) * (m.high - m.low));
    // Just before and after each end, and there if that is rational.
    for (const RangePart& part : range.parts) {
      if (part.to.value.is_rational()) compare_at(part.to.value.rational);
      for (const Rational& near : enclosure(part.to.value, 40)) {
        if (near >= m.low && near <= m.high) compare_at(near);
      }
    }
  }
  for (const unsigned count : seen) CHECK(count > 0);
}

TEST_CASE("pieces compared in the field of a root agree with exact poses", "[mechanism]") {
  std::mt19937 random(381);
  const auto upto = [&](int n) { return static_cast<long>(random() % static_cast<unsigned>(n)); };
  const RigidBody a = RigidBody::of_set(make_box({0, 0, 0}, {2, 1, 1}));
  const ContactPiece moving(a.pieces().front());
  std::array<unsigned, 3> seen{};
  std::array<unsigned, 2> sides{};
  for (int i = 0; i < 240; ++i) {
    const Rational3 at{ratio(upto(9) - 4, 2), ratio(upto(9) - 4, 2), upto(4) == 0 ? 1 : 0};
    const RigidBody b = RigidBody::of_set(make_box(at, {at[0] + 1, at[1] + 1, at[2] + 1}));
    const ContactPiece fixed(b.pieces().front());
    const Joint joint = i % 2 == 0 ? Joint::hinge({0, 0, 1}, {0, 0, 0}) : Joint::slider({1, 1, 0});
    // A half, as 1/4 + sqrt(1/16): exact, but not known to be rational.
    const Rational value = ratio(upto(8), 1) / 2;
    QuadraticRoot root(value - ratio(1, 4));
    root.square = ratio(1, 16);
    root.sign = 1;
    const PlacedPiece placed(moving, joint, root);
    const auto collides = [&](ContactRule contact) {
      return MotionChecker(a, b, contact).check(joint.pose(value)).status == MotionVerdict::Status::kCollides;
    };
    const bool overlaps = collides(ContactRule::kAllow);
    const bool touches = collides(ContactRule::kForbid);
    if (!overlaps) CHECK(placed.touches(fixed) == touches);
    // The same from what holds on both sides, and from the events at the value.
    for (const int side : {-1, 1}) {
      const Rational end = value + Rational(side) / 8;
      std::vector<ContactEvent> events;
      append_events(moving, fixed, EventCell(joint, std::min(value, end), std::max(value, end)), events);
      Rational next = end;
      bool between = false;
      for (const ContactEvent& event : events) {
        if (compare(event.value, root) == 0) {
          between = between || placed.is_between(fixed, event.items);
          continue;
        }
        const auto [low, high] = enclosure(event.value, 40);
        next = side > 0 ? std::min(next, low) : std::max(next, high);
      }
      const RigidPose beside = joint.pose((value + next) / 2);
      if (MotionChecker(a, b, ContactRule::kAllow).check(beside).status != MotionVerdict::Status::kCollides) continue;
      CHECK(between == !overlaps);
      ++sides[between ? 1 : 0];
    }
    ++seen[overlaps ? 2 : touches ? 1 : 0];
  }
  for (const unsigned count : sides) CHECK(count > 0);
  for (const unsigned count : seen) CHECK(count > 0);
}

TEST_CASE("a screw touches at one angle, exactly or between two numbers 2^-64 apart", "[mechanism]") {
  // The bar's top is at 1 + t / 360 of the pitch 1.
  const auto bar_below = [](const std::string& plate) {
    return mechanism(R"J({"moving": "box(-1,-1/4,0, 1,1/4,1)", "fixed": ["box(-3,-3,)J" + plate + R"J(, 3,3,4)"],
        "joint": {"type": "screw", "axis": "z", "pitch": 1, "range": [0, 700]}})J");
  };
  for (const auto& [plate, angle] : {std::pair("9/4", 450.0), std::pair("25/12", 390.0), std::pair("11/5", 432.0)}) {
    const Mechanism m = bar_below(plate);
    const RangeOfMotion range = nef::planner::range_of_motion(m);
    check_cover(range, m);
    REQUIRE(range.parts.size() == 3);
    CHECK(range.parts[0].status == RangeStatus::kFree);
    CHECK(range.parts[1].status == RangeStatus::kTouching);
    CHECK(range.parts[2].status == RangeStatus::kColliding);
    const RangeEnd& end = range.parts[1].from;
    CHECK(degrees(end, m) == Approx(angle).margin(1e-12));
    CHECK(end.between.has_value() == (angle == 432));
    if (end.between) CHECK((*end.between)[1] - (*end.between)[0] < Rational(1, 1L << 62));
    REQUIRE_FALSE(end.stops.empty());
    CHECK(end.stops.front().of_fixed.substr(0, 5) == "facet");
  }
}

TEST_CASE("the corner of a screw grazes a wall at two angles, or passes below it", "[mechanism]") {
  // The corners (4, 3) and (4, -3) are 5 away from the axis; where they graze the wall x = 5 the cosine is 4/5. The top
  // is at 1 + angle / 360, which is 1.1024 and 1.8976 there.
  using Status = RangeStatus;
  const auto range_below = [](const std::string& low) {
    return nef::planner::range_of_motion(mechanism(R"J({"moving": "box(0,-3,0, 4,3,1)", "fixed": ["box(5,-9,)J" + low +
                                                   R"J(, 6,9,99)"],
        "joint": {"type": "screw", "axis": "z", "pitch": 1, "range": [0, 360]}})J"));
  };
  for (const auto& [low, touches] : {std::pair("11/10", 2), std::pair("111/100", 1), std::pair("19/10", 0)}) {
    const RangeOfMotion range = range_below(low);
    REQUIRE(range.parts.size() == 2U * touches + 1);
    for (std::size_t i = 0; i < range.parts.size(); ++i) {
      CHECK(range.parts[i].status == (i % 2 == 0 ? Status::kFree : Status::kTouching));
    }
    if (touches == 2) CHECK(compare(range.parts[1].from.value, Rational(1, 3)) == 0);
    if (touches == 0) continue;
    const RangePart& last = range.parts[range.parts.size() - 2];
    CHECK_FALSE(last.from.between.has_value());
    CHECK(compare(last.from.value, Rational(7, 2)) == 0);
    CHECK(compare(last.to.value, Rational(7, 2)) == 0);
    CHECK(last.from.stops.size() >= 1);
  }
}

TEST_CASE("a screw without a pitch is a hinge", "[mechanism]") {
  std::mt19937 random(12);
  std::size_t ends = 0;
  for (int i = 0; i < 6; ++i) {
    const auto some = [&](int low, int high) {
      return std::to_string(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
    };
    const std::string bodies = R"J({"moving": "box(0,0,0, 5,)J" + some(1, 2) + R"J(,3)", "fixed": ["box()J" +
                               some(1, 4) + "," + some(2, 4) + ",1, 6,6,2)\", \"rotate(box(-6,-" + some(2, 4) +
                               R"J(,1, -1,-1,2), (1,2,2), 30)"], "joint": {"type": )J";
    const Mechanism hinge = mechanism(bodies + R"J("hinge", "axis": "z", "range": [0, 300]}})J");
    const Mechanism screw = mechanism(bodies + R"J("screw", "axis": "z", "pitch": 0, "range": [0, 300]}})J");
    const RangeOfMotion expected = nef::planner::range_of_motion(hinge);
    const RangeOfMotion range = nef::planner::range_of_motion(screw);
    REQUIRE(range.parts.size() == expected.parts.size());
    for (std::size_t k = 0; k < range.parts.size(); ++k) {
      CHECK(range.parts[k].status == expected.parts[k].status);
      const RangeEnd& end = range.parts[k].from;
      CHECK_FALSE(end.between.has_value());
      CHECK(compare(end.value, expected.parts[k].from.value) == 0);
      CHECK(end.stops.size() >= expected.parts[k].from.stops.size());
      ends += end.value.is_rational() ? 0 : 1;
    }
  }
  CHECK(ends > 5);
}

TEST_CASE("random screws against Booleans at many values", "[mechanism]") {
  std::mt19937 random(21);
  std::array<unsigned, 3> seen{};
  std::size_t ends = 0;
  for (int i = 0; i < 10; ++i) {
    const auto some = [&](int low, int high) {
      return std::to_string(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
    };
    const Mechanism m = mechanism(R"J({"moving": "box(-1,-1,0, 5,1,1) + box(4,-1,0, 5,1,)J" + some(2, 3) + R"J()",
        "fixed": ["box()J" + some(1, 3) +
                                  "," + some(2, 4) + "," + some(1, 3) + ", 6,7,9)\", \"rotate(box(-7,-" + some(2, 3) +
                                  "," + some(2, 4) + R"J(, -2,3,5), (1,2,2), )J" + (i % 2 == 0 ? "0" : "30") + R"J()"],
        "joint": {"type": "screw", "axis": "z", "point": [1,0,0], "pitch": ")J" +
                                  some(2, 9) + R"J(/3", "range": [0, 500]}})J");
    const RangeOfMotion range = nef::planner::range_of_motion(m);
    check_cover(range, m);
    std::size_t grazes = 0;
    for (const RangePart& part : range.parts) {
      ends += part.from.between ? 1 : 0;
      if (part.status != RangeStatus::kUndecided) continue;
      // Bodies with whole coordinates graze at some values.
      CHECK(degrees(part.to, m) - degrees(part.from, m) < 1e-12);
      ++grazes;
    }
    for (int k = 0; k < 24; ++k) {
      const Rational value = m.low + Rational(k * 37 % 24 * 2 + 1, 48) * (m.high - m.low);
      const RangeStatus status = true_status(m, m.joint.pose(value));
      CHECK(told_status(range, value) == status);
      ++seen[static_cast<std::size_t>(status)];
    }
    CHECK(grazes < 3);
  }
  CHECK(seen[0] > 10);
  CHECK(seen[2] > 10);
  CHECK(ends > 5);
}

TEST_CASE("planner --range", "[mechanism]") {
  const Folder folder;
  const std::string file =
      folder.write("door.json", R"J({"moving": "box(0,0,0, 3,1/5,2)", "fixed": ["box(2,1,0, 3,2,1)"],
      "joint": {"type": "hinge", "axis": "z", "range": [0, 90]}})J");
  const Run run = planner(folder, "--range " + file + " --json");
  CHECK(run.code == 0);
  const auto report = nlohmann::json::parse(run.out);
  nef::test::check_report_shape(report, "range");
  CHECK(report["joint"] == "hinge");
  REQUIRE(report["parts"].size() == 5);
  CHECK(report["parts"][1]["status"] == "touching");
  CHECK(report["parts"][1]["from"]["degrees"].get<double>() == Approx(15.612285687950443).margin(1e-12));
  CHECK(report["parts"][1]["from"]["stops"][0]["fixed"] == 0);
  CHECK(planner(folder, "--range " + file).out.find("free from 0 to 15.61228568795") == 0);
  const std::string cube = R"J({"moving": "box(0,0,0,1,1,1)", "fixed": )J";
  for (const std::string& rest :
       {std::string(R"J([]})J"), std::string(R"J([], "joint": {"type": "hinge"}})J"),
        std::string(R"J([], "joint": {"type": "slider", "direction": "x"}})J"),
        std::string(R"J([], "joint": {"type": "slider", "direction": "x", "range": [1, 0]}})J"),
        std::string(R"J([3], "joint": {"type": "hinge", "axis": "z"}})J"),
        std::string(R"J(["box(0,0,0,1,1,1"], "joint": {"type": "hinge", "axis": "z"}})J"),
        std::string(R"J([], "joint": {"type": "screw", "axis": [1,1,0], "pitch": 1, "range": [0, 9]}})J"),
        std::string(R"J([], "joint": {"type": "hinge", "axis": "z", "axes": 1}})J")}) {
    const std::string bad = cube + rest;
    INFO(bad);
    const Run refused = planner(folder, "--range " + folder.write("bad.json", bad));
    CHECK(refused.code == 2);
    CHECK(refused.err.substr(0, 9) == "planner: ");
  }
}

}  // namespace
}  // namespace nef::planner::test::range_of_motion
