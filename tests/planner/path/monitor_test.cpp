// SPDX-License-Identifier: Apache-2.0
//
// Who watches the planner stops it wherever it takes long.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <string>

#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/no_path/chart_images.h"
#include "apps/planner/no_path/minimum_cut.h"
#include "apps/planner/no_path/no_rigid_path.h"
#include "apps/planner/path/question.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid_search/motion_fit.h"
#include "apps/planner/rigid_search/rigid_planning.h"
#include "apps/planner/rigid_search/slices.h"
#include "apps/planner/turning/turning_cells.h"
#include "apps/planner/turning/turning_search.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/time_limit.h"
#include "tests/planner/scene_helpers.h"
#include "tests/support/paths.h"

namespace nef::planner::test {
namespace {

TEST_CASE("a monitor stops the free space, its roadmap, and paths, and nothing is kept") {
  const std::atomic<bool> stop{true};
  const Monitor stopped = Monitor().stopped_by(&stop);
  const Scene scene = load("s9_gate_and_rail");
  CHECK_THROWS_AS(free_positions(scene, stopped), Interrupted);
  CHECK_THROWS_AS(Problem(scene, stopped), Interrupted);
  const FreeSpace free(free_positions(scene));
  CHECK_THROWS_AS(free.build_roadmap(stopped), Interrupted);
  CHECK_FALSE(free.has_roadmap());
  CHECK_THROWS_AS(find_path(free, *scene.start, *scene.goal, {}, stopped), Interrupted);
  CHECK(find_path(free, *scene.start, *scene.goal).has_value());
}

TEST_CASE("a time limit stops the free space, and so does what stops the outer monitor") {
  const Scene scene = load("s9_gate_and_rail");
  const TimeLimit over(0.0);
  CHECK_THROWS_AS(free_positions(scene, over.monitor()), Interrupted);
  const std::atomic<bool> stop{true};
  const TimeLimit outer(std::nullopt, Monitor().stopped_by(&stop));
  CHECK_THROWS_AS(free_positions(scene, outer.monitor()), Interrupted);
  const TimeLimit later(1e6);
  CHECK(equal(free_positions(scene, later.monitor()), free_positions(scene)));
}

TEST_CASE("a search for turns that is stopped is undecided") {
  const Scene scene = scene_of(corner("3"));
  for (const int questions : {1, 20}) {
    int asked = 0;
    const StopQuestion question([&] { return ++asked >= questions; });
    const TurningAnswer answer = find_turning_path(scene, question_of(scene), {}, question.monitor());
    CHECK(answer.status == TurningAnswer::Status::kUndecided);
    CHECK_FALSE(answer.open_ranges.empty());
  }
}

TEST_CASE("a search for poses that is stopped is undecided, whenever that is") {
  const Scene scene = load("rigid/elbow");
  const MotionChecker checker = MotionChecker::of_scene(scene);
  const std::atomic<bool> stop{true};
  CHECK(find_rigid_path(scene, checker, {}, Monitor().stopped_by(&stop)).status == AnswerStatus::kUndecided);
  std::size_t slices = 0;
  for (const int questions : {1, 10, 100, 1000, 4000}) {
    int asked = 0;
    const StopQuestion question([&] { return ++asked >= questions; });
    const RigidAnswer answer = find_rigid_path(scene, checker, {.max_samples = 1, .max_boxes = 0}, question.monitor());
    CAPTURE(questions);
    CHECK(answer.status == AnswerStatus::kUndecided);
    CHECK(answer.path.empty());
    CHECK(asked == questions);  // nothing is asked, and so nothing is done that asks, once it has been stopped
    slices = std::max(slices, answer.slices);
  }
  CHECK(slices > 0);
}

TEST_CASE("a monitor stops each part of a search for poses") {
  const std::atomic<bool> stop{true};
  const Monitor stopped = Monitor().stopped_by(&stop);
  const Scene scene = load("rigid/l_window");
  const MotionChecker checker = MotionChecker::of_scene(scene);
  const RigidQuestion question = rigid_question_of(scene);
  const RigidPose inside{{0, 4, 0}, {1, 0, 0, 0}};
  CHECK_THROWS_AS(moves_freely(checker, question.start, inside, stopped), Interrupted);
  CHECK_THROWS_AS(checker.check(inside, {}, stopped), Interrupted);
  const MotionFit fit(checker);
  std::vector<Vector3d> positions{{0, 3, 0}, {0, 5, 0}};
  const std::vector<Quaternion> rotations(2, {1, 0, 0, 0});
  CHECK_THROWS_AS(fit.fit(rotations, positions, 1, 0.1, stopped), Interrupted);
  Slices slices(scene);
  CHECK_THROWS_AS(slices.at({1, 0, 0, 0}, stopped), Interrupted);
  CHECK(slices.at({1, 0, 0, 0}, {}).components.size() == 2);  // before the wall and behind it
  const PathProof::Claim claim = no_path_claim(checker, {question.start, question.goal, {}, {}, {}});
  const Orientations orientations = Orientations::all();
  CHECK_THROWS_AS(BlockingPairs(claim, orientations, {0, 0, 0}, stopped), Interrupted);
  CHECK_THROWS_AS(images_of_charts(claim, orientations, {0, 0, 0}, stopped), Interrupted);
  const WeightedGraph graph{{{1}, {0, 2}, {1}}, {1, 1, 1}};
  CHECK_THROWS_AS(minimum_node_cut(graph, 0, 2, stopped), Interrupted);
  CHECK_FALSE(NoPathSearch(checker, question.start, question.goal).run(100, stopped).proof);
}

TEST_CASE("who watches is asked for each pair of pieces while the first box of a barrier is judged") {
  constexpr int kBoxes = 64;
  std::string obstacles;
  for (int i = 0; i < kBoxes; ++i) {
    const std::string at = std::to_string(3 * i);
    obstacles += (i == 0 ? "\"box(" : ", \"box(") + at + ",2,0, " + at + "+1,3,1)\"";
  }
  const Scene scene = scene_of(R"J({"robot": "box(0,0,0, 1,1,1)", "rotation": "SO(3)", "obstacles": [)J" + obstacles +
                               R"J(], "start": {"position": [0,0,0], "quaternion": [1,0,0,0]},
      "goal": {"position": [0,9,0], "quaternion": [1,0,0,0]}})J");
  const MotionChecker checker = MotionChecker::of_scene(scene);
  const RigidQuestion question = rigid_question_of(scene);
  int asked = 0;
  const StopQuestion counting([&] {
    ++asked;
    return false;
  });
  NoPathSearch(checker, question.start, question.goal).run(1, counting.monitor());
  CHECK(asked > 2 * kBoxes / 8);  // a question asks every eighth time
}

TEST_CASE("a monitor stops the search for turns at which faces are parallel") {
  const std::atomic<bool> stop{true};
  const Scene scene = scene_of(corner("3"));
  const TurningQuestion question = question_of(scene);
  CHECK_FALSE(turns_of_parallel_faces(scene, question, {}).empty());
  CHECK_THROWS_AS(turns_of_parallel_faces(scene, question, Monitor().stopped_by(&stop)), Interrupted);
}

TEST_CASE("an assembly is undecided as far as a monitor stops the search") {
  const Assembly assembly = read_assembly(source_folder() + "/data/planner/assembly/burr.json");
  const std::atomic<bool> stop{true};
  const Disassembly answer = take_apart(assembly, {}, Monitor().stopped_by(&stop));
  CHECK(answer.steps.empty());
  CHECK(answer.inseparable.empty());
  REQUIRE(answer.undecided.size() == 1);
  CHECK(answer.undecided[0].parts.size() == assembly.parts.size());
  CHECK(answer.undecided[0].proved_below == 1);
}

}  // namespace
}  // namespace nef::planner::test
