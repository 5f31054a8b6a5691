// SPDX-License-Identifier: Apache-2.0
//
// Every "no" of a robot that turns about one axis becomes a proof for a file; spoilt ones do not hold. Also
// apps/planner/proofs/check/check_layers.cpp, apps/planner/proofs/check/blocked_poses.cpp and
// apps/planner/proofs/layers_file.cpp.
#include "apps/planner/no_path/turning_barrier.h"

#include <catch2/catch.hpp>
#include <string>

#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/proofs/rotation_claim.h"
#include "apps/planner/turning/turning_search.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

// The proof of a scene that has no path; it is checked, and read back.
PathProof proved(const Scene& scene) {
  const TurningAnswer answer = find_turning_path(scene, question_of(scene));
  REQUIRE(answer.status == TurningAnswer::Status::kInfeasible);
  const std::optional<PathProof> proof = make_turning_proof(scene, *answer.proof);
  REQUIRE(proof.has_value());
  CHECK_FALSE(complaint_about(*proof).has_value());
  CHECK_FALSE(complaint_about(proof->claim, scene).has_value());
  const PathProof read = parse_proof(proof_text(*proof), "test");
  CHECK(proof_text(read) == proof_text(*proof));
  CHECK_FALSE(complaint_about(read).has_value());
  return *proof;
}

// A bar in a tube in which it cannot turn round, though its middle may be anywhere.
Scene bar_in_tube(const std::string& range, const std::string& goal, const std::string& more = "") {
  return scene_of(
      R"J({"robot": "box(-2,-1/2,-1/2, 2,1/2,1/2)", "obstacles": ["box(-9,-4,-4, 9,4,4) - box(-6,-1,-1, 6,1,1)"],
      "rotation": {"range": )J" +
      range + R"J(}, "start": [-3,0,0, 0], "goal": )J" + goal + more + "}");
}

TEST_CASE("a bar that cannot turn round") {
  SECTION("by half a turn") { CHECK(proved(bar_in_tube("[0, 180]", "[-3,0,0, 180]")).claim.rotations->size() == 3); }
  SECTION("on the full circle, which takes two barriers") { proved(bar_in_tube("[0, 360]", "[-3,0,0, 180]")); }
  SECTION("in a range that is closed elsewhere") { proved(bar_in_tube("[-90, 270]", "[-3,0,0, 180]")); }
  SECTION("without contact") { proved(bar_in_tube("[0, 180]", "[-3,0,0, 180]", R"(, "contact": "forbid")")); }
}

TEST_CASE("in a range wider than a full turn, the same orientation a turn later is another one") {
  const Scene scene = bar_in_tube("[0, 720]", "[-3,0,0, 360]");
  PathProof proof = proved(scene);
  CHECK(proof.claim.places == std::array<std::uint32_t, 2>{0, 4});
  // From there to itself nothing is in the way.
  proof.claim.places = {0, 0};
  CHECK(complaint_about(proof) == "start and goal are on the same side of the barrier");
  CHECK(complaint_about(proof.claim, scene) == "the robot of the scene has other rotations");
  proof.claim.places = {0, 99};
  CHECK(complaint_about(proof).has_value());
  // Without places the chain would be closed.
  proof.claim.places.reset();
  CHECK(complaint_about(proof).has_value());
}

TEST_CASE("a bar that is too long for a corner, in a flat box") {
  const Scene scene = scene_of(corner("4"));
  const PathProof proof = proved(scene);
  Scene longer_range = scene;
  longer_range.rotation->high = 180;
  CHECK(complaint_about(proof.claim, longer_range) == "the robot of the scene has other rotations");
}

TEST_CASE("the outside of a cage goes on for ever, about an axis of irrational length") {
  proved(scene_of(
      R"J({"robot": "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "obstacles": ["box(-4,-4,-4, 4,4,4) - box(-2,-2,-2, 2,2,2) - box(1,-1/16,-1/16, 5,1/16,1/16)"],
      "start": [0,0,0, 0], "goal": [9,0,0, 30], "rotation": {"axis": [1,1,1]}})J"));
}

TEST_CASE("a robot that is not convex, without contact") {
  proved(scene_of(R"J({"robot": "box(-1,-1/2,-1/2, 1,1/2,1/2) + box(-1,-1/2,-1/2, 0,3/2,1/2)",
      "obstacles": ["box(-1/4,-6,-6, 1/4,6,6) - box(-1,-1/16,-1/16, 1,1/16,1/16)"], "contact": "forbid",
      "start": [-3,0,0, 0], "goal": [3,0,0, 120], "rotation": {"range": [0, 120]}, "box": [[-5,-5,-5],[5,5,5]]})J"));
}

TEST_CASE("spoilt layers do not hold") {
  const PathProof proof = proved(bar_in_tube("[0, 180]", "[-3,0,0, 180]"));
  const auto complaint = [&](auto&& spoil) {
    PathProof spoilt = proof;
    spoil(spoilt.claim, *spoilt.layers);
    return complaint_about(spoilt).value_or("it holds");
  };
  using Catch::Contains;
  using Claim = PathProof::Claim;
  using Layers = PathProof::Layers;
  const auto barrier = [](Layers& layers) -> std::vector<PathProof::BlockedSimplex>& {
    for (std::vector<PathProof::Layer>& chart : layers.charts) {
      for (PathProof::Layer& layer : chart) {
        if (!layer.barrier.empty()) return layer.barrier;
      }
    }
    throw std::logic_error("there is no barrier");
  };
  const auto closing = [](Layers& layers) -> std::vector<PathProof::BlockedSimplex>& {
    for (std::vector<PathProof::Layer>& chart : layers.charts) {
      for (PathProof::Layer& layer : chart) {
        if (!layer.closing.empty()) return layer.closing;
      }
    }
    throw std::logic_error("nothing is between the layers");
  };
  CHECK_THAT(complaint([](Claim&, Layers& l) { l.charts.pop_back(); }), Contains("each arc"));
  CHECK_THAT(complaint([](Claim&, Layers& l) { l.charts.front().pop_back(); }), Contains("do not go from -1 up to 1"));
  CHECK_THAT(complaint([](Claim&, Layers& l) { l.charts.front().front().until = 2; }), Contains("up to 1"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { barrier(l).pop_back(); }), Contains("border"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { barrier(l).clear(); }), Contains("gap between two layers"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { closing(l).pop_back(); }), Contains("gap between two layers"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { l.charts.back().back().closing = closing(l); }), !Contains("it holds"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { barrier(l).front().corners[0] = 9999; }), Contains("does not exist"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { barrier(l).front().corners.pop_back(); }), Contains("corners"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { barrier(l).front().hit->common[0][1] += 9; }),
             Contains("a point of both"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { barrier(l).front().hit->robot = 9; }), Contains("does not exist"));
  CHECK_THAT(complaint([&](Claim&, Layers& l) { barrier(l).front().hit.reset(); }), Contains("may be free"));
  CHECK_THAT(complaint([](Claim& c, Layers&) { c.path[1].quaternion = {2, 0, 0, 1}; }), Contains("not in the chain"));
  CHECK_THAT(complaint([](Claim& c, Layers&) { c.path[1] = c.path[0]; }), Contains("same side"));
  CHECK_THAT(complaint([](Claim& c, Layers&) { c.rotations = std::vector<Quaternion>{}; }), !Contains("it holds"));
  CHECK_THAT(complaint([](Claim& c, Layers&) {
               for (Rational3& v : c.robot[0]) v = scaled_by(ratio(1, 8), v);
             }),
             Contains("a point of both"));
}

}  // namespace
}  // namespace nef::planner::test
