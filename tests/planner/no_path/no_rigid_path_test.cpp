// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a robot that turns has no path: where there is none, and never where a path is known. All of
// apps/planner/no_path/ that has no test of its own.
#include "apps/planner/no_path/no_rigid_path.h"

#include <catch2/catch.hpp>
#include <string>

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
  CHECK_THAT(complaint([](PathProof& p) {
               p.claim.rotations = {{{1, 0, 0, 0}, {1, 1, 0, 0}}};
             }),
             Contains("boxes of poses"));
  CHECK_THAT(complaint([](PathProof& p) { p.claim.rotations.reset(); }), Contains("boxes of poses"));
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

}  // namespace
}  // namespace nef::planner::test
