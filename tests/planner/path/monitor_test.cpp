// SPDX-License-Identifier: Apache-2.0
//
// Who watches the planner stops it wherever it takes long.
#include <atomic>
#include <catch2/catch.hpp>

#include "apps/planner/assembly/disassembly.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/path/question.h"
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
