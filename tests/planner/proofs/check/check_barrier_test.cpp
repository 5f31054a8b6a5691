// SPDX-License-Identifier: Apache-2.0
//
// Barriers that separate start from goal: they are made where the planner says that there is no path, hold, and do not
// when start and goal are on one side or a triangle is missing or wrong; every triangle by Booleans with the
// configuration space's obstacle. Tests of apps/planner/proofs/make/make_barrier.cpp, too.
#include <catch2/catch.hpp>

#include "apps/planner/proofs/path_proof.h"
#include "apps/planner/proofs/proof_file.h"
#include "nef/construct/construct.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test::check_barrier {
namespace {

// Two rooms and a wall with a hole of height `high`; the robot is 1 high.
std::string rooms(const std::string& robot, const std::string& high, const std::string& more) {
  return R"J({"robot": ")J" + robot + R"J(", "obstacles": ["box(-1,-1,-1, 10,4,4) - interior(box(0,0,0, 9,3,3))",
      "box(4,0,0, 5,3,3) - box(4,1,1, 5,2,)J" +
         high + R"J()"], "start": [1, "1/2", "1/2"], "goal": [7, "3/2", "3/2"])J" + more + "}";
}

std::optional<PathProof> barrier_of(const Scene& scene) {
  const Problem problem(scene);
  const Answer answer = problem.solve();
  REQUIRE(answer.status == Answer::Status::kInfeasible);
  return make_barrier_proof(scene, problem.free_space().set(), *scene.start, *scene.goal);
}

TEST_CASE("A barrier separates start from goal where there is no path", "[proofs]") {
  const std::string cube = "box(0,0,0, 1,1,1)";
  const std::string corner = "box(0,0,0, 1,1,1) - box(1/2,1/2,1/2, 1,1,1)";
  for (const std::string& text :
       {rooms(cube, "1.999999999", ""), rooms(corner, "7/4", ""),
        rooms(cube, "3/2", R"(, "box": [[0, 0, 0], [8, 2, "7/4"]])"), rooms(cube, "3/2", R"(, "contact": "forbid")")}) {
    CAPTURE(text);
    const Scene scene = scene_of(text);
    const std::optional<PathProof> proof = barrier_of(scene);
    REQUIRE(proof);
    const PathProof read = parse_proof(proof_text(*proof), "file");
    CHECK(proof_text(read) == proof_text(*proof));
    CHECK(complaint_about(read) == std::nullopt);
    CHECK(complaint_about(read.claim, scene) == std::nullopt);
    // By Booleans: the triangles have no position that is free.
    const Polyhedron free = Problem(scene).free_space().set();
    std::vector<Polyhedron> triangles;
    for (const PathProof::Triangle& triangle : read.barrier->triangles) {
      std::vector<Rational3> corners;
      for (const std::uint32_t k : triangle.corners) corners.push_back(read.barrier->points[k]);
      triangles.push_back(convex_hull(corners));
    }
    CHECK(intersect(unite_all(triangles), free).is_empty());
  }
}

TEST_CASE("A barrier that does not separate is refused", "[proofs]") {
  const Scene scene = scene_of(rooms("box(0,0,0, 1,1,1)", "3/2", ""));
  const PathProof proof = *barrier_of(scene);
  PathProof same_side = proof;
  same_side.claim.path[1].position = {2, 1, 1};
  CHECK(*complaint_about(same_side) == "start and goal are on the same side of the barrier");
  PathProof open = proof;
  open.barrier->triangles.pop_back();
  CHECK(*complaint_about(open) == "an edge belongs to an odd number of triangles");
  PathProof none = proof;
  none.barrier->triangles.clear();
  CHECK(*complaint_about(none) == "start and goal are on the same side of the barrier");
  PathProof unguarded = proof;
  unguarded.barrier->triangles.front().hit.reset();
  CHECK(*complaint_about(unguarded) == "triangle 0 can be crossed");
  PathProof moved = proof;
  moved.barrier->points.front()[0] += 1;
  CHECK(complaint_about(moved)->find("can be crossed") != std::string::npos);
  PathProof turned = proof;
  turned.claim.path[0].quaternion = {1, 1, 0, 0};
  CHECK(*complaint_about(turned) == "start and goal must not be turned");
  PathProof free = proof;
  free.claim.status = PathProof::Claim::Status::kFree;
  CHECK(complaint_about(free));
}

TEST_CASE("Between two positions of one component there is no barrier", "[proofs]") {
  const Scene scene =
      scene_of(R"J({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(-1,-1,-1, 10,4,4) - interior(box(0,0,0, 9,3,3))",
      "polygon((4,0,0),(4,3,0),(4,3,3),(4,0,3))"], "start": [1,1,1], "goal": [6,1,1], "contact": "allow"})J");
  const Problem problem(scene);
  REQUIRE(problem.solve().status == Answer::Status::kInfeasible);
  CHECK_FALSE(make_barrier_proof(scene, problem.free_space().set(), {1, 1, 1}, {1, 1, ratio(3, 2)}));
}

}  // namespace
}  // namespace nef::planner::test::check_barrier
