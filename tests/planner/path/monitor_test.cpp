// SPDX-License-Identifier: Apache-2.0
//
// Who watches the planner stops it wherever it takes long.
#include <atomic>
#include <catch2/catch.hpp>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/question.h"
#include "apps/planner/turning/turning_search.h"
#include "nef/base/interruption.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

TEST_CASE("a monitor stops the free space, its roadmap, and paths, and nothing is kept") {
  const std::atomic<bool> stop{true};
  BuildOptions stopped;
  stopped.monitor = Monitor().stopped_by(&stop);
  const Scene scene = load("s9_gate_and_rail");
  CHECK_THROWS_AS(free_positions(scene, stopped), Interrupted);
  CHECK_THROWS_AS(Problem(scene, stopped), Interrupted);
  const FreeSpace free(free_positions(scene));
  CHECK_THROWS_AS(free.build_roadmap(stopped.monitor), Interrupted);
  CHECK_FALSE(free.has_roadmap());
  CHECK_THROWS_AS(find_path(free, *scene.start, *scene.goal, {}, stopped.monitor), Interrupted);
  CHECK(find_path(free, *scene.start, *scene.goal).has_value());
}

TEST_CASE("a question and a monitor of the options stop both") {
  const Scene scene = load("s9_gate_and_rail");
  std::atomic<bool> stop{false};
  BuildOptions options;
  options.monitor = Monitor().stopped_by(&stop);
  int asked = 0;
  options.stop = [&asked] { return ++asked > 0; };
  CHECK_THROWS_AS(free_positions(scene, options), Interrupted);
  CHECK(asked == 1);
  options.stop = [&] {
    stop = true;
    return false;
  };
  CHECK_THROWS_AS(free_positions(scene, options), Interrupted);
}

TEST_CASE("a search for turns that is stopped is undecided") {
  const Scene scene = scene_of(corner("3"));
  std::atomic<bool> stop{false};
  TurningLimits limits;
  limits.monitor = Monitor().stopped_by(&stop);
  limits.stop = [&] {
    stop = true;
    return false;
  };
  CHECK(find_turning_path(scene, question_of(scene), limits).status == TurningAnswer::Status::kUndecided);
  CHECK_THROWS_AS(find_turning_path(scene, question_of(scene), limits), Interrupted);
}

}  // namespace
}  // namespace nef::planner::test
