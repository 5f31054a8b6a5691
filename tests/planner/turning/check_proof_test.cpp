// SPDX-License-Identifier: Apache-2.0
//
// Proofs that were found hold when they are checked by other means, and those that were spoilt do not.
#include <catch2/catch.hpp>

#include "apps/planner/turning/turning_search.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

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
             Contains("does not contain its inner robot"));
  CHECK_THAT(complaint([&](TurningProof& p) {
               for (Rational3& v : p.cells[last].inner[0]) v = scaled_by(ratio(1001, 1000), v);
             }),
             Contains("does not contain its inner robot"));
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
      const TurningAnswer answer = find_turning_path(scene, question, {.max_cells = 60});
      REQUIRE(answer.status == TurningAnswer::Status::kInfeasible);
      CHECK(complaint_about(*answer.proof, scene, question).value_or("it holds") == "it holds");
    }
  }
}

}  // namespace
}  // namespace nef::planner::test
