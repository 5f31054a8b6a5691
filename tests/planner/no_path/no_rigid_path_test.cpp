// SPDX-License-Identifier: Apache-2.0
//
// Proofs that a robot that turns has no path: where there is none, and never where a path is known. All of
// apps/planner/no_path/ that has no test of its own.
#include "apps/planner/no_path/no_rigid_path.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <string>

#include "apps/planner/no_path/chart_images.h"
#include "apps/planner/proofs/proof_file.h"
#include "apps/planner/rigid/rigid_question.h"
#include "nef/base/error.h"
#include "nef/base/timing/time_limit.h"
#include "nef/construct/convex_hull.h"
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

// The vertices of a piece, turned about a point, sorted.
std::vector<Rational3> turned(const std::vector<Rational3>& piece, const Rational3& about, const Quaternion& q) {
  const Matrix3 m = rotation_between(q, q);
  std::vector<Rational3> result;
  for (const Rational3& vertex : piece) {
    const Rational3 v = minus(vertex, about);
    result.push_back({dot(m[0], v), dot(m[1], v), dot(m[2], v)});
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST_CASE("charts in which a robot looks as in another one are its images") {
  struct Robot {
    std::string text;
    Rational3 reference;
    std::size_t images;
  };
  const Orientations all = Orientations::all();
  std::mt19937 random(5);
  for (const Robot& robot :
       {Robot{"box(-1,-2,-3, 1,2,3)", {0, 0, 0}, 3}, Robot{"box(0,0,0, 1,2,3)", {ratio(1, 2), 1, ratio(3, 2)}, 3},
        Robot{"box(0,0,0, 1,2,3)", {0, 0, 0}, 0},
        Robot{"box(-3,-1,0, -1,1,1) + box(-1,-1/2,0, 1,1/2,1/2) + box(1,-1,0, 3,1,1)", {0, 0, 0}, 2}}) {
    INFO(robot.text);
    const Scene scene = scene_of(R"J({"robot": ")J" + robot.text + R"J(", "obstacles": ["box(9,9,9, 10,10,10)"]})J");
    PathProof::Claim claim;
    const RigidBody body = RigidBody::of_set(scene.robot);
    for (const RigidBody::Piece& piece : body.pieces()) claim.robot.push_back(piece.mesh.vertices);
    const std::vector<std::optional<ChartImage>> images = images_of_charts(claim, all, robot.reference);
    std::size_t count = 0;
    for (std::uint32_t chart = 0; chart < 4; ++chart) {
      if (!images[chart]) continue;
      ++count;
      const ChartImage& image = *images[chart];
      REQUIRE(image.of < chart);
      for (int i = 0; i < 5; ++i) {
        Quaternion q = all.charts()[image.of].origin;
        Quaternion there = all.charts()[chart].origin;
        for (std::size_t k = 0; k < 3; ++k) {
          const Rational at = ratio(static_cast<long>(random() % 9) - 4, 4);
          for (std::size_t c = 0; c < 4; ++c) {
            q[c] += at * all.charts()[image.of].directions[k][c];
            there[c] += image.signs[k] * at * all.charts()[chart].directions[image.becomes[k]][c];
          }
        }
        for (std::size_t piece = 0; piece < claim.robot.size(); ++piece) {
          CHECK(turned(claim.robot[image.pieces[piece]], robot.reference, there) ==
                turned(claim.robot[piece], robot.reference, q));
        }
      }
    }
    CHECK(count == robot.images);
    // With a box the origin must stay, too.
    claim.box = {{{0, 0, 0}, {1, 1, 1}}};
    const auto in_box = images_of_charts(claim, all, robot.reference);
    const auto left = std::count_if(in_box.begin(), in_box.end(), [](const auto& image) { return image.has_value(); });
    CHECK(static_cast<std::size_t>(left) == (is_zero(robot.reference) ? robot.images : 0));
  }
}

TEST_CASE("a dumbbell, which one half turn takes onto itself, does not pass a slit") {
  const std::string dumbbell =
      "box(-3/2,-1/2,-1/2, -1/2,1/2,1/2) + box(-1/2,-1/4,-1/2, 1/2,1/4,1/4) + box(1/2,-1/2,-1/2, 3/2,1/2,1/2)";
  const NoPathAnswer answer = prove_no_rigid_path(scene_of(wall(dumbbell, "box(-1,-1/16,-1/16, 1,1/16,1/16)", kInBox)));
  REQUIRE(answer.proof.has_value());
  CHECK_FALSE(complaint_about(*answer.proof).has_value());
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

// All lengths of a proof, multiplied.
void scale(PathProof& proof, const Rational& by) {
  const auto grow = [&](Rational3& v) { v = scaled_by(by, v); };
  for (ProofPieces* pieces : {&proof.claim.robot, &proof.claim.obstacles}) {
    for (std::vector<Rational3>& piece : *pieces) std::for_each(piece.begin(), piece.end(), grow);
  }
  for (RigidPose& pose : proof.claim.path) grow(pose.position);
  for (Rational3& corner : *proof.claim.box) grow(corner);
  grow(proof.cells->reference);
  for (Rational3& corner : proof.cells->bounds) grow(corner);
  std::vector<PathProof::PoseCell*> open;
  for (PathProof::PoseCell& chart : proof.cells->charts) open.push_back(&chart);
  for (std::size_t i = 0; i < open.size(); ++i) {
    PathProof::PoseCell& cell = *open[i];
    if (cell.kind == PathProof::PoseCell::Kind::kCut && cell.axis < 3) cell.at *= by;
    std::for_each(cell.common.begin(), cell.common.end(), grow);
    std::for_each(cell.drift.begin(), cell.drift.end(), grow);
    for (PathProof::PoseCell& half : cell.halves) open.push_back(&half);
  }
}

// The check compares short numbers in machine words, long ones by Integer.
TEST_CASE("proofs in long numbers hold as in short ones, and spoilt ones do not") {
  const NoPathAnswer answer = prove_no_rigid_path(
      scene_of(wall("box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "box(-1,-1/16,-1/16, 1,1/16,1/16)", kInBox)));
  REQUIRE(answer.proof.has_value());
  PathProof spoilt = *answer.proof;
  std::vector<PathProof::PoseCell*> open;
  for (PathProof::PoseCell& chart : spoilt.cells->charts) open.push_back(&chart);
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i]->kind == PathProof::PoseCell::Kind::kBlocked) open[i]->common[3] = open[i]->common[0];
    for (PathProof::PoseCell& half : open[i]->halves) open.push_back(&half);
  }
  for (const char* factor : {"1", "1000000007/3", "100000000000000000000000000000000000000007/3"}) {
    INFO(factor);
    PathProof proof = *answer.proof;
    scale(proof, Rational(factor));
    CHECK_FALSE(complaint_about(proof).has_value());
    PathProof off = spoilt;
    scale(off, Rational(factor));
    CHECK_THAT(complaint_about(off).value_or("it holds"), Catch::Contains("a point of"));
  }
}

// A blocked box of a proof whose points drift, and where it is.
struct DriftingBox {
  PathProof::PoseCell* cell;
  std::uint32_t chart;
  std::array<Rational, 6> low, high;
};

std::vector<DriftingBox> drifting_boxes(PathProof& proof) {
  std::vector<DriftingBox> open;
  std::vector<DriftingBox> result;
  for (std::uint32_t chart = 0; chart < 4; ++chart) {
    DriftingBox& all = open.emplace_back(DriftingBox{&proof.cells->charts[chart], chart, {}, {}});
    for (std::size_t k = 0; k < 3; ++k) {
      all.low[k] = proof.cells->bounds[0][k];
      all.high[k] = proof.cells->bounds[1][k];
      all.low[3 + k] = -1;
      all.high[3 + k] = 1;
    }
  }
  while (!open.empty()) {
    const DriftingBox box = open.back();
    open.pop_back();
    if (!box.cell->drift.empty()) result.push_back(box);
    for (std::size_t i = 0; i < box.cell->halves.size(); ++i) {
      DriftingBox half = box;
      (i == 0 ? half.high : half.low)[box.cell->axis] = box.cell->at;
      half.cell = &box.cell->halves[i];
      open.push_back(half);
    }
  }
  return result;
}

// At a random pose of a box its point is in the obstacle, and inside the cube that the robot is.
void check_drifting_point(const DriftingBox& box, const Polyhedron& obstacle, std::mt19937& random) {
  std::array<Rational, 6> share;
  for (Rational& x : share) x = ratio(static_cast<long>(random() % 9), 8);
  Rational3 position;
  for (std::size_t k = 0; k < 3; ++k) position[k] = box.low[k] + share[k] * (box.high[k] - box.low[k]);
  Quaternion q = Orientations::all().charts()[box.chart].origin;
  Rational3 point{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational at = box.low[3 + k] + share[3 + k] * (box.high[3 + k] - box.low[3 + k]);
    for (std::size_t c = 0; c < 4; ++c) q[c] += at * Orientations::all().charts()[box.chart].directions[k][c];
    for (std::size_t i = 0; i < 3; ++i) point[i] += (2 * share[3 + k] - 1) * box.cell->drift[k][i];
  }
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Rational weight = 1;
    for (std::size_t k = 0; k < 3; ++k) weight *= ((corner >> k) & 1) != 0 ? share[k] : Rational(1 - share[k]);
    for (std::size_t i = 0; i < 3; ++i) point[i] += weight * box.cell->common[corner][i];
  }
  CHECK(contains(obstacle, point));
  const Matrix3 turn = rotation_between(q, q);
  const Rational3 seen = minus(point, position);
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational along = turn[0][k] * seen[0] + turn[1][k] * seen[1] + turn[2][k] * seen[2];
    CHECK(abs(along) < ratio(1, 2));
  }
}

TEST_CASE("points that drift while the robot turns stay in the obstacle and in the robot") {
  const NoPathAnswer answer = prove_no_rigid_path(
      scene_of(wall("box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "box(-1,-19/40,-19/40, 1,19/40,19/40)", kInBox)));
  REQUIRE(answer.proof.has_value());
  PathProof proof = *answer.proof;
  const std::vector<DriftingBox> boxes = drifting_boxes(proof);
  REQUIRE_FALSE(boxes.empty());
  std::mt19937 random(39);
  for (const DriftingBox& box : boxes) {
    const Polyhedron obstacle = convex_hull(proof.claim.obstacles[box.cell->obstacle]);
    for (int i = 0; i < 4; ++i) check_drifting_point(box, obstacle, random);
  }
  const std::string text = proof_text(proof);
  CHECK(proof_text(parse_proof(text, "test")) == text);
  CHECK_FALSE(complaint_about(parse_proof(text, "test")).has_value());
  for (const char* factor : {"1000000007/3", "100000000000000000000000000000000000000007/3"}) {
    PathProof scaled = proof;
    scale(scaled, Rational(factor));
    CHECK_FALSE(complaint_about(scaled).has_value());
  }
  const auto complaint = [&](auto&& spoil) {
    PathProof spoilt = *answer.proof;
    spoil(*drifting_boxes(spoilt).front().cell);
    return complaint_about(spoilt).value_or("it holds");
  };
  using Cell = PathProof::PoseCell;
  using Catch::Contains;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK_THAT(complaint([&](Cell& cell) { cell.drift[k][i] += 2; }), Contains("a point of both"));
    }
  }
  CHECK_THAT(complaint([](Cell& cell) { cell.drift.pop_back(); }), Contains("drift with each"));
}

TEST_CASE("a search for a proof goes on where its limits have stopped it") {
  const Scene scene = scene_of(wall("box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "box(-1,-1/8,-1/8, 1,1/8,1/8)", kInBox));
  const RigidQuestion question = rigid_question_of(scene);
  const MotionChecker checker = MotionChecker::of_scene(scene);
  NoPathSearch search(checker, question.start, question.goal);
  NoPathAnswer answer;
  std::size_t runs = 0;
  for (std::size_t cells = 50; !answer.proof && runs < 100; cells += 50, ++runs) {
    answer = search.run(cells);
    CHECK(answer.cells <= cells + 1);
    CHECK(answer.in_question.boxes.empty() == answer.proof.has_value());
    for (const auto& box : answer.in_question.boxes) CHECK(box[0][0] < box[1][0]);
  }
  CHECK(runs > 1);
  REQUIRE(answer.proof.has_value());
  CHECK_FALSE(complaint_about(*answer.proof).has_value());
}

TEST_CASE("a proof is the same on one thread and on three, and so is what is in question", "[threads]") {
  for (const char* hole : {"box(-1,-1/8,-1/8, 1,1/8,1/8)", "box(-1,-19/40,-19/40, 1,19/40,19/40)"}) {
    INFO(hole);
    const Scene scene = scene_of(wall("box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", hole, kInBox));
    const NoPathAnswer one = prove_no_rigid_path(scene);
    const NoPathAnswer three = prove_no_rigid_path(scene, {}, Monitor().on_threads(3));
    REQUIRE(one.proof.has_value());
    REQUIRE(three.proof.has_value());
    CHECK(proof_text(*one.proof) == proof_text(*three.proof));
    CHECK(one.cells == three.cells);
    const NoPathAnswer some = prove_no_rigid_path(scene, {.max_cells = 40});
    const NoPathAnswer some_on_three = prove_no_rigid_path(scene, {.max_cells = 40}, Monitor().on_threads(3));
    CHECK_FALSE(some.proof.has_value());
    CHECK(some.cells == some_on_three.cells);
    CHECK(some.in_question.boxes == some_on_three.in_question.boxes);
  }
}

TEST_CASE("a search that is out of boxes ends, also where all that it looks at is open") {
  const Scene scene = load("rigid/l_window");
  const RigidQuestion question = rigid_question_of(scene);
  const MotionChecker checker = MotionChecker::of_scene(scene);
  const TimeLimit limit(100);
  NoPathSearch search(checker, question.start, question.goal);
  CHECK_FALSE(search.run(225, limit.monitor()).proof);
  CHECK(limit.passed() < 100);
}

#ifndef NEF_SANITIZED  // it takes some seconds
TEST_CASE("a tetrahedron does not pass a hole of nine tenths of its width, which takes less than the default limit") {
  const Scene scene =
      scene_of(wall("hull((1,1,1),(1,-1,-1),(-1,1,-1),(-1,-1,1))", "box(-1,-9/10,-9/10, 1,9/10,9/10)", kInBox));
  CHECK(prove_no_rigid_path(scene, {}, Monitor().on_threads(2)).proof.has_value());
}
#endif

TEST_CASE("no proof where there is a path, or the limits are narrow") {
  const std::string cube = "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)";
  CHECK_FALSE(prove_no_rigid_path(scene_of(wall(cube, "box(-1,-1/2,-1/2, 1,1/2,1/2)", kInBox)), {.max_cells = 200})
                  .proof.has_value());
  CHECK_FALSE(prove_no_rigid_path(scene_of(wall(cube, "box(-1,-2,-2, 1,2,2)", kInBox)), {.max_cells = 200}).proof);
  const NoPathAnswer few =
      prove_no_rigid_path(scene_of(wall(cube, "box(-1,-1/8,-1/8, 1,1/8,1/8)", kInBox)), {.max_cells = 9});
  CHECK_FALSE(few.proof.has_value());
  CHECK_FALSE(few.in_question.boxes.empty());
  Scene same_side = scene_of(wall(cube, "box(-1,-1/8,-1/8, 1,1/8,1/8)", kInBox));
  same_side.goal = Rational3{-3, 2, 0};
  CHECK_FALSE(prove_no_rigid_path(same_side, {.max_cells = 100}).proof.has_value());
}

}  // namespace
}  // namespace nef::planner::test
