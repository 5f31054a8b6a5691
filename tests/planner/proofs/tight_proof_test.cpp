// SPDX-License-Identifier: Apache-2.0
//
// Proofs that passages are tight: they hold where free space has such passages, there are none elsewhere, and what is
// changed in one is refused: apps/planner/proofs/make/make_tight.cpp and apps/planner/proofs/check/check_tight.cpp.
#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/proofs/make/answer_proof.h"
#include "apps/planner/proofs/proof_file.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test::tight_proof {
namespace {

Scene scene_of(const std::string& robot, const std::string& obstacles, const AffineMap& map = AffineMap::identity()) {
  Scene scene = parse_scene("{\"robot\": \"" + robot + "\", \"obstacles\": [" + obstacles + "]}", "", "test");
  scene.robot = transform(scene.robot, map);
  for (Polyhedron& obstacle : scene.obstacles) obstacle = transform(obstacle, map);
  return scene;
}

const char* const kCube = "box(0,0,0, 1,1,1)";
// Holes as wide as the cube in both directions, in one, and a place for it alone.
const char* const kHole = "\"box(4,0,0, 6,9,9) - box(3,3,3, 7,4,4)\"";
const char* const kSlot = "\"box(4,0,0, 6,9,9) - box(3,3,3, 7,6,4)\"";
const char* const kCell = "\"box(3,3,3, 6,6,6) - box(4,4,4, 5,5,5)\"";

PathProof proof_of(const Scene& scene) {
  const FreeSpace free(free_positions(scene));
  PathProof proof = proof_of_tight_passages(scene, free);
  CHECK(proof.claim.path.size() == free.passages().size());
  for (std::size_t i = 0; i < free.passages().size(); ++i) {
    CHECK(static_cast<int>(proof.claim.along[i].size()) == free.passages()[i].dimension);
  }
  return proof;
}

void check_holds(const Scene& scene) {
  const std::string text = proof_text(proof_of(scene));
  const PathProof read = parse_proof(text, "proof");
  CHECK(proof_text(read) == text);
  CHECK(complaint_about(read).value_or("") == "");
  CHECK(complaint_about(read.claim, scene).value_or("") == "");
}

TEST_CASE("proofs of tight passages hold") {
  for (const char* obstacle : {kHole, kSlot, kCell}) {
    INFO(obstacle);
    check_holds(scene_of(kCube, obstacle));
    check_holds(scene_of(kCube, obstacle, oblique_rotation()));
    AffineMap shear = AffineMap::identity();
    shear.linear[0][2] = 3;
    shear.linear[1][0] = Rational(5, 2);
    check_holds(scene_of(kCube, obstacle, shear));
  }
  for (const char* name : {"s1_tight_hole", "s2_tight_slot", "s9_gate_and_rail", "s10_t_slot", "s14_two_ways", "peg"}) {
    INFO(name);
    check_holds(read_scene(scene(name)));
  }
}

TEST_CASE("a side of the box narrows a passage, too") {
  Scene low = scene_of(kCube, "\"box(4,0,1, 6,9,9)\"");
  low.box = {Rational3{0, 0, 0}, Rational3{9, 8, 8}};
  check_holds(low);
  const PathProof proof = proof_of(low);
  REQUIRE(proof.tight.size() == 1);
  CHECK(std::any_of(proof.tight[0].contacts.begin(), proof.tight[0].contacts.end(),
                    [](const PathProof::Tight::Contact& contact) { return contact.side == 2; }));
  PathProof changed = proof;
  for (PathProof::Tight::Contact& contact : changed.tight[0].contacts) {
    if (contact.side) contact.side = 5;
  }
  CHECK(complaint_about(changed));
  changed = proof;
  changed.claim.box.reset();
  CHECK(complaint_about(changed));
}

TEST_CASE("there are no proofs where no passage is tight") {
  const Scene wide = scene_of(kCube, "\"box(4,0,0, 6,9,9) - box(3,3,3, 7,5,5)\"");
  const FreeSpace free(free_positions(wide));
  CHECK_FALSE(make_tight_proof(wide, free));
  CHECK_THROWS_AS(proof_of_tight_passages(wide, free), InputError);
}

TEST_CASE("random boxes on a grid: positions near a tight passage are free along it only") {
  unsigned proved = 0;
  unsigned unproved = 0;
  for (unsigned seed = 0; seed < seeds(8); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto upto = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    Scene scene;
    scene.robot = make_box({0, 0, 0}, {1, 1, 1});
    scene.box = {Rational3{0, 0, 0}, Rational3{5, 5, 5}};
    for (int i = 0; i < 9; ++i) {
      const Rational3 low{upto(6), upto(6), upto(6)};
      scene.obstacles.push_back(make_box(low, {low[0] + 1 + upto(3), low[1] + 1 + upto(3), low[2] + 1 + upto(3)}));
      scene.obstacle_names.emplace_back("box");
    }
    const FreeSpace free(free_positions(scene));
    if (free.passages().empty()) continue;
    free.build_roadmap();
    const std::optional<PathProof> proof = make_tight_proof(scene, free);
    if (!proof) {
      ++unproved;
      continue;
    }
    ++proved;
    CHECK(complaint_about(*proof).value_or("") == "");
    for (std::size_t i = 0; i < proof->claim.path.size(); ++i) {
      const std::vector<Rational3>& along = proof->claim.along[i];
      for (int k = 0; k < 40; ++k) {
        const Rational3 d{upto(7) - 3, upto(7) - 3, upto(7) - 3};
        const Rational3 step{d[0] / 1000, d[1] / 1000, d[2] / 1000};
        if (!free.is_free(ExactPoint(plus(proof->claim.path[i].position, step)))) continue;
        const bool leads_along = along.size() == 2   ? dot(cross(along[0], along[1]), d) == 0
                                 : along.size() == 1 ? is_zero(cross(along[0], d))
                                                     : is_zero(d);
        CHECK(leads_along);
      }
    }
  }
  CHECK(proved > nef::test::fewer(2));
  CHECK(unproved <= proved);
}

TEST_CASE("changed proofs of tight passages are refused") {
  const Scene scene = scene_of(kCube, kHole, oblique_rotation());
  const PathProof proof = proof_of(scene);
  REQUIRE_FALSE(complaint_about(proof));
  PathProof changed = proof;
  changed.claim.along[0].clear();  // it is free along the hole
  CHECK(complaint_about(changed));
  changed = proof;
  changed.claim.along[0][0] = {1, 0, 0};
  CHECK(complaint_about(changed));
  changed = proof;
  changed.claim.along[0].push_back(changed.claim.along[0][0]);
  CHECK(complaint_about(changed));
  changed = proof;
  changed.claim.path[0].position[0] += Rational(1, 1000);
  CHECK(complaint_about(changed));
  changed = proof;
  changed.claim.contact = ContactRule::kForbid;
  CHECK(complaint_about(changed));
  changed = proof;
  changed.claim.path[0].quaternion = {1, 0, 0, 1};
  CHECK(complaint_about(changed));
  changed = proof;
  changed.claim.status = PathProof::Claim::Status::kFree;
  CHECK(complaint_about(changed));
  for (std::size_t i = 0; i < proof.tight[0].contacts.size(); ++i) {
    changed = proof;
    changed.tight[0].contacts[i].common.robot[0] += Rational(1, 7);
    CHECK(complaint_about(changed));
    changed = proof;
    changed.tight[0].contacts[i].obstacle = 1000;
    CHECK(complaint_about(changed));
  }
  for (std::size_t octant = 0; octant < 8; ++octant) {
    changed = proof;
    PathProof::Tight::Cone* cone = &changed.tight[0].octants[octant];
    while (cone->edge) cone = &cone->halves[0];
    cone->contact = 1000;
    CHECK(complaint_about(changed));
  }
  // A wider hole has other contacts: the claim is not about it.
  const Scene wide = scene_of(kCube, "\"box(4,0,0, 6,9,9) - box(3,3,3, 7,5,5)\"", oblique_rotation());
  CHECK(complaint_about(proof.claim, wide));
}

TEST_CASE("planner --tight --proof and --check-proof") {
  const Folder folder;
  const std::string proof = folder.file("tight.proof");
  CHECK(planner(folder, scene("s1_tight_hole") + " --tight --proof " + proof).code == 0);
  const Run held = planner(folder, scene("s1_tight_hole") + " --check-proof " + proof);
  CHECK(held.code == 0);
  CHECK(held.out == "the proof holds: tight\n");
  CHECK(planner(folder, scene("s2_tight_slot") + " --check-proof " + proof).code == 1);
  const Run none = planner(folder, scene("s1_wider") + " --tight --proof " + folder.file("none.proof"));
  CHECK(none.code == 2);
  CHECK_THAT(none.err, Catch::Contains("no passage is tight"));
  CHECK_FALSE(std::filesystem::exists(folder.file("none.proof")));
}

}  // namespace
}  // namespace nef::planner::test::tight_proof
