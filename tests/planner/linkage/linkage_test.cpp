// SPDX-License-Identifier: Apache-2.0
//
// Linkages: what is enclosed and what is told of motions, against places in long double at many samples, where only
// what is clear by more than rounding counts.
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/linkage/linkage_checker.h"
#include "apps/planner/linkage_ompl/linkage_validity.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::linkage {
namespace {

using Long3 = Eigen::Matrix<long double, 3, 1>;
using LongMatrix = Eigen::Matrix<long double, 3, 3>;
using Status = MotionVerdict::Status;

constexpr long double kClear = 1e-9L;

struct LongPlace {
  LongMatrix turn = LongMatrix::Identity();
  Long3 shift = Long3::Zero();
};

// Where all links are, step by step from the base.
std::vector<LongPlace> places(const Linkage& linkage, const std::vector<long double>& values) {
  std::vector<LongPlace> result(linkage.links.size());
  std::size_t value = 0;
  for (std::size_t i = 1; i < linkage.links.size(); ++i) {
    const LinkageJoint& joint = linkage.links[i].joint;
    const LongPlace& parent = result[joint.parent];
    Eigen::Quaternion<long double> turn(joint.turn[0], joint.turn[1], joint.turn[2], joint.turn[3]);
    turn.normalize();
    const Long3 axis = joint.axis.cast<long double>().normalized();
    result[i].shift = parent.shift + parent.turn * joint.shift.cast<long double>();
    result[i].turn = parent.turn * turn.toRotationMatrix();
    if (joint.kind == LinkageJoint::Kind::kRevolute) {
      result[i].turn = result[i].turn * Eigen::AngleAxis<long double>(values[value++], axis).toRotationMatrix();
    } else if (joint.kind == LinkageJoint::Kind::kPrismatic) {
      result[i].shift += result[i].turn * (axis * values[value++]);
    }
  }
  return result;
}

std::vector<long double> values_at(const std::vector<double>& from, const std::vector<double>& to, long double s) {
  std::vector<long double> result;
  for (std::size_t i = 0; i < from.size(); ++i)
    result.push_back(from[i] + s * (static_cast<long double>(to[i]) - from[i]));
  return result;
}

std::vector<Long3> placed(const RigidBody::Piece& piece, const LongPlace& place) {
  std::vector<Long3> result;
  for (const Vector3d& p : piece.points) result.push_back(place.turn * p.cast<long double>() + place.shift);
  return result;
}

std::vector<Long3> directions(const RigidBody::Piece& piece, const LongPlace& place) {
  std::vector<Long3> result;
  for (const Vector3d& n : piece.normals) result.push_back(place.turn * n.cast<long double>());
  return result;
}

// The largest gap along normals of both and, of boxes, products of these: negative where they overlap.
long double gap_between(const RigidBody& a, const LongPlace& at_a, const RigidBody& b, const LongPlace& at_b) {
  long double least = 1e9L;
  for (const RigidBody::Piece& p : a.pieces()) {
    for (const RigidBody::Piece& q : b.pieces()) {
      const std::vector<Long3> of_p = placed(p, at_a);
      const std::vector<Long3> of_q = placed(q, at_b);
      std::vector<Long3> normals = directions(p, at_a);
      const std::vector<Long3> others = directions(q, at_b);
      const std::size_t count = normals.size();
      for (std::size_t i = 0; i < count; ++i) {
        for (const Long3& other : others) {
          const Long3 n = normals[i].cross(other);
          if (n.norm() > 1e-6L) normals.push_back(n.normalized());
        }
      }
      normals.insert(normals.end(), others.begin(), others.end());
      long double gap = -1e9L;
      for (const Long3& n : normals) {
        long double low_p = 1e9L, high_p = -1e9L, low_q = 1e9L, high_q = -1e9L;
        for (const Long3& x : of_p) {
          low_p = std::min(low_p, n.dot(x));
          high_p = std::max(high_p, n.dot(x));
        }
        for (const Long3& x : of_q) {
          low_q = std::min(low_q, n.dot(x));
          high_q = std::max(high_q, n.dot(x));
        }
        gap = std::max({gap, low_q - high_p, low_p - high_q});
      }
      least = std::min(least, gap);
    }
  }
  return least;
}

RigidBody box_body(const Rational3& low, const Rational3& high) { return RigidBody::of_set(make_box(low, high)); }

Link link(const std::string& name, LinkageJoint::Kind kind, std::size_t parent, const Vector3d& shift,
          const Vector3d& axis, std::optional<RigidBody> body, const std::array<double, 4>& turn = {1, 0, 0, 0}) {
  return {name, std::move(body), {kind, parent, shift, turn, axis}};
}

// An arm of six joints, one of them a slider, and a finger beside its hand.
Linkage arm() {
  using Kind = LinkageJoint::Kind;
  const RigidBody bone = box_body({ratio(-1, 8), ratio(-1, 8), 0}, {ratio(1, 8), ratio(1, 8), 1});
  Linkage result;
  result.links.push_back(link("base", Kind::kFixed, 0, {0, 0, 0}, {0, 0, 1},
                              box_body({ratio(-1, 2), ratio(-1, 2), -1}, {ratio(1, 2), ratio(1, 2), 0})));
  result.links.push_back(link("turret", Kind::kRevolute, 0, {0, 0, 0.1}, {0, 0, 1}, bone));
  result.links.push_back(link("shoulder", Kind::kRevolute, 1, {0, 0, 1}, {0, 1, 0}, bone));
  result.links.push_back(link("elbow", Kind::kRevolute, 2, {0, 0, 1}, {0, 2, 1}, bone));
  result.links.push_back(link("stretch", Kind::kPrismatic, 3, {0, 0, 0.9}, {0, 0, 1}, bone));
  result.links.push_back(link("wrist", Kind::kRevolute, 4, {0, 0, 1}, {1, 0, 0}, bone, {0.9, 0, 0.1, 0.3}));
  result.links.push_back(link("mount", Kind::kFixed, 5, {0.2, 0, 0.5}, {0, 0, 1}, std::nullopt));
  result.links.push_back(link("finger", Kind::kRevolute, 6, {0, 0, 0}, {0, 1, 1}, bone));
  result.allowed.push_back({7, 5});  // the finger is fixed beside the wrist, in whose bone it begins
  return result;
}

std::vector<double> random_values(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-2.5, 2.5);
  std::vector<double> values;
  for (int i = 0; i < 6; ++i) values.push_back(angle(random) / (i == 0 ? 1 : i == 3 ? 8 : 2));
  return values;
}

TEST_CASE("What a link sweeps is enclosed, seen from the base and from other links", "[linkage]") {
  const Linkage robot = arm();
  std::mt19937 random(17);
  std::uniform_real_distribution<double> part(0, 1);
  std::uniform_real_distribution<double> any(-1, 1);
  double tightest = 0;
  for (unsigned i = 0; i < 40; ++i) {
    const std::vector<double> from = random_values(random);
    const std::vector<double> to = random_values(random);
    const double width = i % 2 == 0 ? 1.0 / 16 : 1.0 / 256;
    const double begin = part(random) * (1 - width);
    for (std::size_t moving = 1; moving < robot.links.size(); ++moving) {
      for (const std::size_t seen_from : {std::size_t{0}, (moving + 3) % robot.links.size()}) {
        if (seen_from == moving) continue;
        const LinkChain chain(robot, seen_from, moving);
        const Vector3d point(any(random), any(random), any(random));
        const MotionCell cell = chain.part({from, to}, begin, begin + width, point.norm());
        std::vector<Vector3d> images;
        cell.for_each_image(point, [&](const Vector3d& image) { images.push_back(image); });
        for (int k = 0; k <= 8; ++k) {
          const auto all = places(robot, values_at(from, to, begin + static_cast<long double>(width) * k / 8));
          const Long3 world = all[moving].turn * point.cast<long double>() + all[moving].shift;
          const Long3 there = all[seen_from].turn.transpose() * (world - all[seen_from].shift);
          for (int d = 0; d < 4; ++d) {
            const Long3 n = Vector3d(any(random), any(random), any(random)).normalized().cast<long double>();
            long double most = -1e9L;
            for (const Vector3d& image : images) most = std::max(most, n.dot(image.cast<long double>()));
            REQUIRE(n.dot(there) <= most + cell.slack + 1e-12L);
            tightest = std::max(tightest, static_cast<double>((n.dot(there) - most) / cell.slack));
          }
        }
      }
    }
  }
  // The slack is no waste: some point needs a good part of it.
  CHECK(tightest > 0.02);
}

TEST_CASE("Verdicts on motions of a linkage hold at samples", "[linkage]") {
  std::mt19937 random(18);
  const auto coordinate = [&] { return ratio(static_cast<long>(random() % 97) - 48, 16); };
  std::array<unsigned, 3> seen{};
  for (unsigned scene = 0; scene < seeds(6); ++scene) {
    std::vector<RigidBody> boxes;
    for (int k = 0; k < 5; ++k) {
      const Rational3 at{coordinate(), coordinate(), coordinate() + 1};
      boxes.push_back(box_body(at, {at[0] + ratio(1, 2), at[1] + ratio(1, 2), at[2] + ratio(1, 2)}));
    }
    const LinkageChecker checker(arm(), RigidBody::together(boxes));
    const RigidBody obstacles = RigidBody::together(boxes);
    const std::vector<Link>& links = checker.linkage().links;
    const auto least_gap = [&](const std::vector<long double>& values) {
      const auto all = places(checker.linkage(), values);
      long double gap = 1e9L;
      for (std::size_t i = 1; i < links.size(); ++i) {
        if (!links[i].body) continue;
        gap = std::min(gap, gap_between(*links[i].body, all[i], obstacles, {}));
        for (std::size_t j = 0; j < i; ++j) {
          if (!links[j].body || links[i].joint.parent == j || (i == 7 && j == 5)) continue;
          gap = std::min(gap, gap_between(*links[i].body, all[i], *links[j].body, all[j]));
        }
      }
      return gap;
    };
    for (int k = 0; k < 12; ++k) {
      const std::vector<double> from = random_values(random);
      std::vector<double> to = random_values(random);
      for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + (to[i] - from[i]) / 4;
      CheckLimits limits;
      limits.in_order = k % 3 == 0;
      const LinkageVerdict verdict = checker.check(from, to, limits);
      ++seen[static_cast<std::size_t>(verdict.status)];
      if (verdict.status == Status::kCollides) {
        CHECK(least_gap(values_at(from, to, verdict.parameter)) < kClear);
      }
      for (int s = 0; s <= 16; ++s) {
        const long double at = s / 16.0L;
        if (verdict.status == Status::kFree || (limits.in_order && at < verdict.free_until)) {
          CHECK(least_gap(values_at(from, to, at)) > -kClear);
        }
      }
    }
  }
  CHECK(seen[0] > 0);
  CHECK(seen[1] > 0);
}

TEST_CASE("Links that touch along their motion are undecided, and bad linkages are refused", "[linkage]") {
  using Kind = LinkageJoint::Kind;
  const RigidBody cube = box_body({0, 0, 0}, {1, 1, 1});
  Linkage sledge;
  sledge.links.push_back(link("base", Kind::kFixed, 0, {0, 0, 0}, {0, 0, 1}, std::nullopt));
  sledge.links.push_back(link("sledge", Kind::kPrismatic, 0, {0, 0, 0}, {1, 0, 0}, cube));
  const std::vector<double> zero{0};
  const std::vector<double> two{2};
  const std::vector<double> three{3};
  const std::vector<double> six{6};
  CheckLimits limits;
  limits.depth = 6;
  const LinkageChecker on_floor(sledge, box_body({-9, -9, -1}, {9, 9, 0}));
  CHECK(on_floor.check(zero, three, limits).status == Status::kUndecided);
  CHECK(on_floor.check(zero).status == Status::kUndecided);
  const LinkageChecker above(sledge, box_body({-9, -9, -2}, {9, 9, -1}));
  CHECK(above.check(zero, three, limits).status == Status::kFree);
  const LinkageChecker stopped(sledge, box_body({2, 0, 0}, {3, 1, 1}));
  const LinkageVerdict hits = stopped.check(zero, three, limits);
  CHECK(hits.status == Status::kCollides);
  CHECK(hits.link == 1);
  CHECK_FALSE(hits.other);
  limits.depth = 12;
  limits.in_order = true;
  const double until = stopped.check(zero, three, limits).free_until;
  CHECK(until <= 1.0 / 3);
  CHECK(until > 1.0 / 3 - 1.0 / 1024);

  // A load on the sledge runs into the base, which it shares no joint with.
  Linkage train = sledge;
  train.links[0].body = box_body({4, 0, 0}, {5, 1, 1});
  train.links[1].body.reset();
  train.links.push_back(link("load", Kind::kFixed, 1, {0, 0, 0}, {0, 0, 1}, cube));
  const LinkageChecker alone(train, RigidBody::together({}));
  CHECK(alone.check(zero, two).status == Status::kFree);
  const LinkageVerdict itself = alone.check(zero, six);
  CHECK(itself.status == Status::kCollides);
  CHECK(itself.link == 2);
  CHECK(itself.other == 0);
  train.allowed.push_back({0, 2});
  CHECK(LinkageChecker(train, RigidBody::together({})).check(zero, six).status == Status::kFree);

  sledge.links[1].joint.parent = 1;
  CHECK_THROWS_AS(LinkageChecker(sledge, cube), InputError);
  sledge.links[1].joint.parent = 0;
  sledge.links[1].joint.axis = {0, 0, 0};
  CHECK_THROWS_AS(LinkageChecker(sledge, cube), InputError);
}

TEST_CASE("A stock planner on joint values returns paths that hold between samples", "[linkage]") {
  namespace ob = ompl::base;
  namespace og = ompl::geometric;
  ompl::RNG::setSeed(5);
  const auto checker = std::make_shared<const LinkageChecker>(arm(), box_body({1, -1, 0}, {2, 1, 4}));
  const auto space = std::make_shared<ob::RealVectorStateSpace>(6);
  space->setBounds(-3, 3);
  og::SimpleSetup setup(space);
  const auto si = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<LinkageStateValidityChecker>(si, checker));
  si->setMotionValidator(std::make_shared<LinkageMotionValidator>(si, checker));
  setup.setPlanner(std::make_shared<og::RRTConnect>(si));
  ob::ScopedState<> start(space);
  ob::ScopedState<> goal(space);
  start = std::vector<double>{-1.2, 0.8, 0.2, 0, 0.3, 0.5};
  goal = std::vector<double>{1.2, 0.8, 0.2, 0, 0.3, 0.5};
  setup.setStartAndGoalStates(start, goal);
  REQUIRE(setup.solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
  setup.simplifySolution();
  const auto& states = setup.getSolutionPath().getStates();
  const auto values = [&](const ob::State* state) {
    const double* v = state->as<ob::RealVectorStateSpace::StateType>()->values;
    return std::vector<double>(v, v + 6);
  };
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    CHECK(checker->check(values(states[i]), values(states[i + 1])).status == Status::kFree);
  }
  // The straight motion goes through the block; lastValid is before it.
  ob::ScopedState<> last(space);
  std::pair<ob::State*, double> valid{last.get(), 0.0};
  CHECK_FALSE(si->getMotionValidator()->checkMotion(start.get(), goal.get(), valid));
  CHECK(valid.second > 0);
  CHECK(valid.second < 1);
  CHECK(checker->check(values(start.get()), values(last.get())).status == Status::kFree);
  CHECK_THROWS_AS(LinkageMotionValidator(
                      std::make_shared<ob::SpaceInformation>(std::make_shared<ob::RealVectorStateSpace>(5)), checker),
                  InputError);
}

}  // namespace
}  // namespace nef::planner::test::linkage
