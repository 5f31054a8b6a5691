// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a robot that turns has no path: where there is none, and never where a path is known. All of
// apps/planner/no_path/ that has no test of its own.
#include "apps/planner/no_path/no_rigid_path.h"

#include <catch2/catch.hpp>
#include <string>

#include "apps/planner/orientation/rotation_claim.h"
#include "apps/planner/proofs/proof_file.h"
#include "nef/base/error.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

// A robot in front of a wall, half a unit thick, with a hole around the x axis; behind the wall it is turned.
std::string wall(const std::string& robot, const std::string& hole, const std::string& more = "") {
  return R"J({"robot": ")J" + robot + R"J(", "obstacles": ["box(-1/4,-6,-6, 1/4,6,6) - )J" + hole +
         R"J("], "start": {"position": [-3,0,0], "quaternion": [1,0,0,0]},
    "goal": {"position": [3,0,0], "quaternion": [1,2,0,0]}, "rotation": "SO(3)")J" +
         more + "}";
}

const std::string kInBox = R"J(, "box": [[-5,-5,-5],[5,5,5]])J";

TEST_CASE("a cube does not pass a hole that is smaller than it") {
  const Scene scene = scene_of(wall("box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "box(-1,-1/8,-1/8, 1,1/8,1/8)", kInBox));
  const NoPathAnswer answer = prove_no_rigid_path(scene);
  REQUIRE(answer.proof.has_value());
  CHECK_FALSE(complaint_about(*answer.proof).has_value());
  CHECK_FALSE(complaint_about(answer.proof->claim, scene).has_value());
  const PathProof read = parse_proof(proof_text(*answer.proof), "test");
  CHECK(proof_text(read) == proof_text(*answer.proof));
  CHECK_FALSE(complaint_about(read).has_value());
  // Of other scenes.
  const Scene wider = scene_of(wall("box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "box(-1,-3/4,-3/4, 1,3/4,3/4)", kInBox));
  CHECK(complaint_about(answer.proof->claim, wider).has_value());
  Scene elsewhere = scene;
  elsewhere.goal = Rational3{3, 1, 0};
  CHECK(complaint_about(answer.proof->claim, elsewhere) == "the scene has another start or goal");
  elsewhere.turns_freely = false;
  CHECK(complaint_about(answer.proof->claim, elsewhere) == "the robot of the scene does not turn");
}

TEST_CASE("spoilt proofs do not hold") {
  const NoPathAnswer answer = prove_no_rigid_path(
      scene_of(wall("box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "box(-1,-1/16,-1/16, 1,1/16,1/16)", kInBox)));
  REQUIRE(answer.proof.has_value());
  const auto complaint = [&](auto&& spoil) {
    PathProof proof = *answer.proof;
    spoil(proof);
    return complaint_about(proof).value_or("it holds");
  };
  using Catch::Contains;
  using Kind = PathProof::PoseCell::Kind;
  const auto first = [](PathProof& proof, Kind kind) -> PathProof::PoseCell& {
    std::vector<PathProof::PoseCell*> open;
    for (PathProof::PoseCell& chart : proof.cells->charts) open.push_back(&chart);
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i]->kind == kind) return *open[i];
      for (PathProof::PoseCell& half : open[i]->halves) open.push_back(&half);
    }
    throw InputError("there is no such box");
  };
  CHECK_THAT(complaint([](PathProof& p) { p.cells->charts.pop_back(); }), Contains("a box for each chart"));
  CHECK_THAT(complaint([&](PathProof& p) { first(p, Kind::kBlocked).kind = Kind::kStart; }), Contains("facet"));
  CHECK_THAT(complaint([&](PathProof& p) { first(p, Kind::kStart).kind = Kind::kGoal; }), !Contains("it holds"));
  CHECK_THAT(complaint([&](PathProof& p) { first(p, Kind::kBlocked).common[3][1] += 9; }), Contains("a point of"));
  CHECK_THAT(complaint([&](PathProof& p) { first(p, Kind::kBlocked).common.pop_back(); }), Contains("each corner"));
  CHECK_THAT(complaint([&](PathProof& p) { first(p, Kind::kBlocked).obstacle = 99; }), Contains("does not exist"));
  CHECK_THAT(complaint([&](PathProof& p) { first(p, Kind::kCut).at += 100; }), Contains("cut outside"));
  CHECK_THAT(complaint([&](PathProof& p) { first(p, Kind::kCut).axis = 6; }), Contains("cut outside"));
  CHECK_THAT(complaint([](PathProof& p) { p.cells->bounds[1][2] -= 2; }), Contains("too narrow"));
  CHECK_THAT(complaint([](PathProof& p) { p.cells->reference[0] += 3; }), !Contains("it holds"));
  CHECK_THAT(complaint([](PathProof& p) { p.claim.path[1].position[0] = -4; }), Contains("goal"));
  CHECK_THAT(complaint([](PathProof& p) {
               for (Rational3& v : p.claim.robot[0]) v = scaled_by(ratio(1, 8), v);
             }),
             !Contains("it holds"));
  CHECK_THAT(complaint([](PathProof& p) { p.claim.rotations = {{{1, 0, 0, 0}, {1, 1, 0, 0}}}; }), Contains("chart"));
  CHECK_THAT(complaint([](PathProof& p) { p.claim.rotations.reset(); }), Contains("boxes of poses"));
}

TEST_CASE("proofs without a box: the outside goes on for ever") {
  // In a cage with a hole. About one axis this takes a fraction of what it does about all, in the same way.
  const Scene caged = scene_of(
      R"J({"robot": "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "obstacles": ["box(-4,-4,-4, 4,4,4) - box(-2,-2,-2, 2,2,2) - box(1,-1/16,-1/16, 5,1/16,1/16)"],
      "start": [0,0,0, 0], "goal": [9,0,0, 30], "rotation": {"axis": "z"}})J");
  const NoPathAnswer out = prove_no_rigid_path(caged);
  REQUIRE(out.proof.has_value());
  CHECK_FALSE(complaint_about(out.proof->claim, caged).has_value());
  CHECK_FALSE(out.proof->cells->outside_at_start);
}

TEST_CASE("proofs with forbidden contact, of a robot that is not convex") {
  const NoPathAnswer answer = prove_no_rigid_path(scene_of(
      R"J({"robot": "box(-1,-1/2,-1/2, 1,1/2,1/2) + box(-1,-1/2,-1/2, 0,3/2,1/2)",
      "obstacles": ["box(-1/4,-6,-6, 1/4,6,6) - box(-1,-1/16,-1/16, 1,1/16,1/16)"], "contact": "forbid",
      "start": [-3,0,0, 0], "goal": [3,0,0, 120], "rotation": {"axis": [1,1,1]}, "box": [[-5,-5,-5],[5,5,5]]})J"));
  CHECK(answer.proof.has_value());
}

// A bar in a tube in which it cannot turn round.
std::string bar_in_tube(const std::string& rotation, const std::string& goal) {
  return R"J({"robot": "box(-2,-1/2,-1/2, 2,1/2,1/2)", "obstacles": ["box(-9,-4,-4, 9,4,4) - box(-6,-1,-1, 6,1,1)"],
      "rotation": )J" +
         rotation + R"J(, "start": [-3,0,0, 0], "goal": )J" + goal + "}";
}

TEST_CASE("where every position is free at some angle, a barrier of positions and angles is found") {
  // Start and goal are the same position, half a turn apart.
  const Scene scene = scene_of(bar_in_tube(R"({"range": [0, 180]})", "[-3,0,0, 180]"));
  const NoPathAnswer answer = prove_no_rigid_path(scene);
  REQUIRE(answer.proof.has_value());
  CHECK_FALSE(complaint_about(answer.proof->claim, scene).has_value());
  const PathProof read = parse_proof(proof_text(*answer.proof), "test");
  CHECK_FALSE(complaint_about(read).has_value());
  // Without its blocked boxes it is no barrier.
  using Kind = PathProof::PoseCell::Kind;
  for (const Kind side : {Kind::kStart, Kind::kGoal}) {
    PathProof spoilt = *answer.proof;
    std::vector<PathProof::PoseCell*> open;
    for (PathProof::PoseCell& chart : spoilt.cells->charts) open.push_back(&chart);
    for (std::size_t i = 0; i < open.size(); ++i) {
      for (PathProof::PoseCell& half : open[i]->halves) open.push_back(&half);
      if (open[i]->kind == Kind::kBlocked) open[i]->kind = side;
    }
    CHECK(complaint_about(spoilt).has_value());
  }
  // The full circle is closed, so it takes two barriers.
  const Scene ring = scene_of(R"J({"robot": "box(-2,-1/2,0, 2,1/2,1)", "rotation": {"range": [0, 360]},
      "obstacles": ["box(-20,-20,-1, 20,20,2) - interior(box(-15,-1,-2, 15,1,3))"],
      "box": [[-12,-12,0],[12,12,0]], "start": [-3,0,0, 0], "goal": [-3,0,0, 180]})J");
  const NoPathAnswer both = prove_no_rigid_path(ring);
  REQUIRE(both.proof.has_value());
  CHECK_FALSE(complaint_about(both.proof->claim, ring).has_value());
  // A little turn is free.
  CHECK_FALSE(
      prove_no_rigid_path(scene_of(bar_in_tube(R"({"range": [0, 180]})", "[2,0,0, 10]")), {.max_cells = 1000}).proof);
}

TEST_CASE("no proof where there is a path, or the limits are narrow") {
  const std::string cube = "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)";
  CHECK_FALSE(prove_no_rigid_path(scene_of(wall(cube, "box(-1,-1/2,-1/2, 1,1/2,1/2)", kInBox)), {.max_cells = 200})
                  .proof.has_value());
  CHECK_FALSE(prove_no_rigid_path(scene_of(wall(cube, "box(-1,-2,-2, 1,2,2)", kInBox)), {.max_cells = 200}).proof);
  const NoPathAnswer few =
      prove_no_rigid_path(scene_of(wall(cube, "box(-1,-1/8,-1/8, 1,1/8,1/8)", kInBox)), {.max_cells = 9});
  CHECK_FALSE(few.proof.has_value());
  CHECK(few.in_question > 0);
  Scene same_side = scene_of(wall(cube, "box(-1,-1/8,-1/8, 1,1/8,1/8)", kInBox));
  same_side.goal = Rational3{-3, 2, 0};
  CHECK_FALSE(prove_no_rigid_path(same_side, {.max_cells = 100}).proof.has_value());
}

TEST_CASE("about one axis a chain of arcs takes the place of all rotations") {
  // A bar that is much too long for the corner.
  const Scene scene = scene_of(corner("6"));
  const NoPathAnswer answer = prove_no_rigid_path(scene);
  REQUIRE(answer.proof.has_value());
  CHECK(answer.proof->claim.rotations->size() == 2);
  CHECK_FALSE(complaint_about(answer.proof->claim, scene).has_value());
  Scene longer_range = scene;
  longer_range.rotation->high = 180;
  CHECK(complaint_about(answer.proof->claim, longer_range) == "the robot of the scene has other rotations");
  CHECK_FALSE(prove_no_rigid_path(scene_of(corner("3.5")), {.max_cells = 1500}).proof.has_value());
  // The full circle is closed.
  longer_range.rotation->high = 360;
  CHECK(rotation_claim_of(longer_range).chain.size() == 5);
  CHECK(prove_no_rigid_path(longer_range).proof.has_value());
  longer_range.rotation->high = 400;
  CHECK_THROWS_WITH(prove_no_rigid_path(longer_range), Catch::Contains("full turn"));
}

}  // namespace
}  // namespace nef::planner::test
