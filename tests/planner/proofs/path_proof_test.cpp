// SPDX-License-Identifier: Apache-2.0
//
// Proofs of paths: those that are written hold, and what they claim is true by Booleans; of the same proofs with one
// thing changed, those that still hold claim nothing else.
#include "apps/planner/proofs/path_proof.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/planner/proofs/proof_file.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test::path_proof {
namespace {

using nlohmann::json;
using ClaimStatus = PathProof::Claim::Status;

// What the program does with --path and --proof.
std::optional<PathProof> proof_of(const Scene& scene, const std::vector<RigidPose>& poses) {
  const MotionChecker checker = MotionChecker::of_scene(scene);
  return make_path_proof(checker, poses);
}

// What is wrong with a proof for someone who has the scene and the path.
std::optional<std::string> complaint(const PathProof& proof, const Scene& scene, const std::vector<RigidPose>& poses) {
  if (auto found = complaint_about(proof)) return found;
  if (auto found = complaint_about(proof.claim, scene)) return found;
  const bool same = std::equal(
      poses.begin(), poses.end(), proof.claim.path.begin(), proof.claim.path.end(),
      [](const RigidPose& a, const RigidPose& b) { return a.position == b.position && a.quaternion == b.quaternion; });
  if (!same) return "another path";
  return std::nullopt;
}

Scene scene_with(const std::string& robot, const std::string& obstacle, const std::string& more) {
  return scene_of(R"J({"robot": ")J" + robot + R"J(", "obstacles": [")J" + obstacle + R"J("])J" + more + "}");
}

const std::vector<std::string> kRobots{"box(-1,-1/4,-1/2, 1,1/4,1/2)", "box(-1,-1,0, 1,1,1/2) + box(-1,-1,0, 0,0,2)",
                                       "hull(-1,-1,-1, 1,0,0, 0,1,0, 0,0,1)", "polygon((-1,0,0),(1,0,0),(0,1,0))"};
const std::vector<std::string> kObstacles{"box(-6,2,-6, 6,3,6) - box(-1,2,-1/2, 1,3,1/2)",
                                          "box(-9,-9,-2, 9,9,-1) + hull(2,2,-1, 3,2,-1, 2,3,-1, 2,2,3)",
                                          "polygon((-3,3,-3),(3,3,-3),(3,3,3),(-3,3,3))"};
const std::vector<std::string> kMore{"", R"(, "contact": "forbid")", R"(, "box": [[-4,-4,-4],[4,5,4]])"};

// Short numbers, and often the same place or rotation twice.
RigidPose random_pose(std::mt19937& random) {
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  RigidPose pose{{ratio(number(-8, 8), 2), number(-3, 6), ratio(number(-4, 4), 2)}, {1, 0, 0, 0}};
  if (number(0, 2) != 0) pose.quaternion = {number(1, 9), number(-3, 3), number(-3, 3), number(-3, 3)};
  return pose;
}

Polyhedron moved(const Polyhedron& robot, const Matrix3& turn, const Rational3& position) {
  return transform(robot, AffineMap{turn, position});
}

bool truly_collides(const Scene& scene, const Matrix3& turn, const Rational3& position) {
  const Polyhedron robot = moved(scene.robot, turn, position);
  const Polyhedron& obstacle = scene.obstacles.front();
  const bool open = scene.contact == ContactRule::kAllow && robot.is_regular() && obstacle.is_regular();
  return !(open ? intersect(interior(robot), interior(obstacle)) : intersect(robot, obstacle)).is_empty();
}

// The pose of a collision by Booleans, with its position at both ends of the interval; a free path at some poses.
void check_truth(const PathProof& proof, const Scene& scene) {
  const std::vector<RigidPose>& path = proof.claim.path;
  if (proof.collision) {
    const PathProof::Collision& c = *proof.collision;
    const RigidPose& from = path[c.motion];
    const RigidPose& to = path[std::min(c.motion + 1, path.size() - 1)];
    Quaternion q = from.quaternion;
    const int sign = scalar_product(from.quaternion, to.quaternion) < 0 ? -1 : 1;
    for (std::size_t k = 0; k < 4; ++k) q[k] = (1 - c.parameter) * q[k] + c.parameter * sign * to.quaternion[k];
    for (const Rational& time : c.times) {
      Rational3 position;
      for (std::size_t k = 0; k < 3; ++k) position[k] = (1 - time) * from.position[k] + time * to.position[k];
      CHECK(truly_collides(scene, rotation_between(q, q), position));
    }
  }
  if (proof.claim.status != ClaimStatus::kFree) return;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const RigidMotion motion(path[i], path[i + 1], MotionTiming::kSlerp);
    for (const double s : {0.0, 0.3, 0.5, 0.8, 1.0}) {
      const RigidPose pose = motion.at(s);
      const bool between = s != 0 && s != 1 && motion.turns();
      // Between the ends of a motion that turns, the position is rounded: contact there cannot be told from overlap.
      if (between && scene.contact == ContactRule::kAllow) continue;
      CHECK_FALSE(truly_collides(scene, rotation_between(pose.quaternion, pose.quaternion), pose.position));
    }
  }
}

TEST_CASE("Proofs of random paths hold, and what they claim is true", "[proofs]") {
  std::mt19937 random(7);
  std::size_t free = 0;
  std::size_t blocked = 0;
  for (unsigned round = 0; round < seeds(60); ++round) {
    const auto pick = [&](const std::vector<std::string>& list) { return list[random() % list.size()]; };
    const std::string robot = pick(kRobots);
    const std::string obstacle = pick(kObstacles);
    const std::string more = pick(kMore);
    CAPTURE(round, robot, obstacle, more);
    const Scene scene = scene_with(robot, obstacle, more);
    std::vector<RigidPose> poses;
    for (std::size_t n = 1 + random() % 3; n > 0; --n) poses.push_back(random_pose(random));
    const std::optional<PathProof> proof = proof_of(scene, poses);
    if (!proof) continue;
    const PathProof read = parse_proof(proof_text(*proof), "file");
    CHECK(proof_text(read) == proof_text(*proof));
    CHECK(complaint(read, scene, poses) == std::nullopt);
    check_truth(read, scene);
    ++(read.claim.status == ClaimStatus::kFree ? free : blocked);
    // The opposite claim has no proof of these parts.
    PathProof opposite = read;
    opposite.claim.status = read.claim.status == ClaimStatus::kFree ? ClaimStatus::kBlocked : ClaimStatus::kFree;
    CHECK(complaint_about(opposite));
  }
  CHECK(free > nef::test::fewer(5));
  CHECK(blocked > 5);
}

TEST_CASE("A proof about one scene is none about another", "[proofs]") {
  const std::vector<RigidPose> poses{{{0, 0, 0}, {1, 0, 0, 1}}, {{0, 1, 0}}};
  const Scene scene = scene_with(kRobots[0], kObstacles[0], "");
  const PathProof proof = *proof_of(scene, poses);
  CHECK(complaint(proof, scene, poses) == std::nullopt);
  CHECK(*complaint(proof, scene_with(kRobots[0], kObstacles[0], R"(, "contact": "forbid")"), poses) ==
        "the scene has a different contact rule");
  CHECK(*complaint(proof, scene_with(kRobots[0], kObstacles[0], R"(, "box": [[-9,-9,-9],[9,9,9]])"), poses) ==
        "the scene has a different box");
  CHECK(*complaint(proof, scene_with("box(-1,-1/4,-1/2, 1,1/4,1/3)", kObstacles[0], ""), poses) ==
        "the solid pieces of the robot are not those of the scene");
  CHECK(*complaint(proof, scene_with(kRobots[0], kObstacles[0] + " + segment(0,8,0, 1,8,0)", ""), poses) ==
        "the flat pieces of the obstacles are not those of the scene");
}

// Every value in a proof that is no list and no object.
void collect_leaves(json& value, std::vector<json*>& leaves, std::vector<json*>& lists) {
  if (value.is_array() && !value.empty()) lists.push_back(&value);
  if (!value.is_structured()) leaves.push_back(&value);
  for (json& entry : value) {
    if (value.is_structured()) collect_leaves(entry, leaves, lists);
  }
}

// One change: a number that grows, or becomes another one; two values exchanged; an entry dropped, or written twice.
void tamper(json& root, std::mt19937& random) {
  std::vector<json*> leaves;
  std::vector<json*> lists;
  collect_leaves(root, leaves, lists);
  json& leaf = *leaves[random() % leaves.size()];
  json& list = *lists[random() % lists.size()];
  switch (random() % 6) {
    case 0:
      leaf = leaf.is_string() ? json(std::to_string(static_cast<int>(random() % 7) - 3)) : json(random() % 4);
      break;
    case 1:
      if (!leaf.is_string() || !try_parse_rational(leaf.get<std::string>())) return;
      leaf = to_string(parse_rational(leaf.get<std::string>()) + ratio(1, 1 + static_cast<long>(random() % 1000)));
      break;
    case 2:
      std::swap(leaf, *leaves[random() % leaves.size()]);
      break;
    case 3:
      list.erase(random() % list.size());
      break;
    case 4:
      list.push_back(json(list[random() % list.size()]));
      break;
    default:
      std::swap(list[random() % list.size()], list[random() % list.size()]);
  }
}

TEST_CASE("Proofs that were tampered with are refused, or prove the same claim", "[proofs]") {
  const std::vector<RigidPose> turning{{{0, -1, 0}, {3, 0, 0, 1}}, {{0, 0, 0}}, {{0, 4, 0}}, {{1, 5, 0}, {2, 0, 1, 1}}};
  const std::vector<RigidPose> blocked{{{0, -1, 0}, {3, 0, 0, 1}}, {{0, 4, 0}, {3, 1, 0, 1}}};
  const std::vector<std::pair<Scene, std::vector<RigidPose>>> cases{
      {scene_with(kRobots[0], kObstacles[0], ""), turning},
      {scene_with(kRobots[0], kObstacles[0], ""), blocked},
      {scene_with(kRobots[1], kObstacles[1], R"(, "contact": "forbid")"), {{{0, 0, 1}, {9, 1, 0, 0}}, {{0, 0, 3}}}},
      {scene_with(kRobots[2], kObstacles[2], kMore[2]), {{{0, 0, 0}}, {{0, 6, 0}}}}};
  std::mt19937 random(11);
  std::size_t held = 0;
  for (const auto& [scene, poses] : cases) {
    const std::optional<PathProof> proof = proof_of(scene, poses);
    REQUIRE(proof);
    const json root = json::parse(proof_text(*proof));
    for (unsigned round = 0; round < seeds(400); ++round) {
      json changed = root;
      tamper(changed, random);
      if (changed == root) continue;
      try {
        const PathProof read = parse_proof(changed.dump(), "file");
        if (complaint(read, scene, poses)) continue;
      } catch (const InputError& error) {
        CHECK_THAT(error.what(), Catch::StartsWith("file: "));
        continue;
      }
      ++held;
      CAPTURE(changed.diff(root, changed).dump());
      // The claim is the same: other vertices may only stand for the same set. What shows it may differ.
      CHECK(changed["claim"]["status"] == root["claim"]["status"]);
      CHECK(changed["claim"]["path"] == root["claim"]["path"]);
      for (const json& change : json::diff(root, changed)) {
        const std::string where = change["path"];
        const bool irrelevant =
            where.find("/normal/") != std::string::npos || where.find("/until") != std::string::npos ||
            where.find("/times/") != std::string::npos || where.find("/planes") != std::string::npos ||
            where.find("/claim/robot") != std::string::npos || where.find("/claim/obstacles") != std::string::npos;
        CHECK(irrelevant);
      }
    }
  }
  CHECK(held < seeds(400) / 2);
}

TEST_CASE("planner writes proofs of paths and checks them", "[proofs]") {
  const Folder folder;
  const std::string scene = folder.write("scene.json", R"J({"robot": "box(-2,-1/4,-1/2, 2,1/4,1/2)",
      "obstacles": ["box(-6,4,-6, 6,5,6) - box(-3,4,-1/2, 3,5,1/2)"], "start": [0,0,0], "goal": [0,9,0]})J");
  const std::string turning = folder.write("turning.path", "0 0 0 0 0 1 1\n0 1 0 0 0 0 1\n0 9 0 0 0 0 1\n");
  const std::string proof = folder.file("a.proof");
  CHECK(planner(folder, scene + " --path " + turning + " --proof " + proof).code == 0);
  const Run holds = planner(folder, scene + " --path " + turning + " --check-proof " + proof);
  CHECK(holds.code == 0);
  CHECK(holds.out == "the proof holds: path\n");
  // A path that is found, by translation.
  CHECK(planner(folder, scene + " --proof " + proof).code == 0);
  CHECK(planner(folder, scene + " --check-proof " + proof).out == "the proof holds: path\n");
  const Run other = planner(folder, scene + " --path " + turning + " --check-proof " + proof);
  CHECK(other.code == 1);
  CHECK_THAT(other.out, Catch::Contains("another path"));
  const std::string straight = folder.write("straight.path", "0 0 0\n0 9 1\n");
  CHECK(planner(folder, scene + " --path " + straight + " --proof " + proof).code == 1);
  CHECK(planner(folder, scene + " --json --check-proof " + proof).code == 0);
  // An end that is not free; no answer.
  CHECK(planner(folder, scene + " --goal 0,4,2 --proof " + proof).code == 3);
  CHECK(planner(folder, scene + " --check-proof " + proof).out == "the proof holds: blocked\n");
  // No path, although the hole is too low by a billionth only.
  const std::string narrower = planner::test::scene("s1_narrower");
  CHECK(planner(folder, narrower + " --proof " + proof).code == 1);
  CHECK(planner(folder, narrower + " --check-proof " + proof).out == "the proof holds: infeasible\n");
  const Run wider = planner(folder, planner::test::scene("s1_tight_hole") + " --check-proof " + proof);
  CHECK(wider.code == 1);
  CHECK_THAT(wider.out, Catch::Contains("not those of the scene"));
  const Run bad = planner(folder, scene + " --check-proof " + folder.write("b.proof", R"({"claim": 1})"));
  CHECK(bad.code == 2);
  CHECK_THAT(bad.err, Catch::Contains("'nef_proof' is missing"));
}

TEST_CASE("the proof that a straight path collides where it touches at one time only", "[proofs]") {
  const Scene scene = scene_with("box(0,0,0, 1,1,1)", "box(4/3,2/3,0, 3,3,1)", R"(, "contact": "forbid")");
  const std::vector<RigidPose> path{{{0, 0, 0}}, {{1, -1, 0}}};
  const std::optional<PathProof> proof = proof_of(scene, path);
  REQUIRE(proof.has_value());
  REQUIRE(proof->collision.has_value());
  CHECK(proof->collision->parameter == ratio(1, 3));
  CHECK(complaint(*proof, scene, path) == std::nullopt);
}

}  // namespace
}  // namespace nef::planner::test::path_proof
