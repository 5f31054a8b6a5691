// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/wide_answer.h"

#include <algorithm>

#include "apps/minkowski/minkowski.h"
#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"

namespace nef::planner {
namespace {

// Below, cutting into convex cells is no more work than a convolution.
constexpr std::size_t kMeshFacets = 200;

bool is_bounded_solid(const Polyhedron& set) { return set.is_bounded() && set.is_regular(); }

// The closure of the positions at which the robot is away from all obstacles. With int O + int -R the forbidden
// positions, their closure is the union of the closed sums, so the inside of free space is the complement of that.
Polyhedron wide_positions(const Scene& scene, const BuildOptions& build, const Monitor& monitor) {
  minkowski::MinkowskiOptions options;
  options.threads = build.threads;
  options.progress = [&build](std::size_t done, std::size_t total) {
    if (build.progress) build.progress("configuration space", done, total);
    return true;
  };
  options.monitor = monitor;
  const Polyhedron reflected = minkowski::negate(scene.robot, monitor);
  std::vector<Polyhedron> sums;
  for (const Polyhedron& obstacle : scene.obstacles) {
    sums.push_back(minkowski::minkowski_sum(obstacle, reflected, options));
  }
  const Polyhedron free = closure(complement(unite_all(sums, build.threads, monitor)), monitor);
  return scene.box ? intersect(free, make_box((*scene.box)[0], (*scene.box)[1], monitor), 1, monitor) : free;
}

}  // namespace

bool can_have_wide_answer(const Scene& scene) {
  return !scene.rotation && scene.contact == ContactRule::kAllow && scene.start && scene.goal &&
         is_bounded_solid(scene.robot) && std::all_of(scene.obstacles.begin(), scene.obstacles.end(), is_bounded_solid);
}

bool may_have_wide_answer(const Scene& scene) {
  const auto is_mesh = [](const Polyhedron& set) { return set.complex().facets.size() >= kMeshFacets; };
  return (is_mesh(scene.robot) || std::any_of(scene.obstacles.begin(), scene.obstacles.end(), is_mesh)) &&
         can_have_wide_answer(scene);
}

std::optional<WideAnswer> wide_answer(const Scene& scene, const PathOptions& options, const BuildOptions& build) {
  NEF_ASSERT(can_have_wide_answer(scene));
  const StopQuestion question(build.stop, build.monitor);
  const Monitor& monitor = question.monitor();
  Stopwatch watch;
  WideAnswer result;
  Answer& answer = result.answer;
  Polyhedron positions = wide_positions(scene, build, monitor);
  answer.phases["configuration_space"] = watch.lap();
  result.free = std::make_shared<const FreeSpace>(std::move(positions));
  answer.phases["cells"] = watch.lap();
  const FreeSpace& free = *result.free;
  const CellId start = free.locate(ExactPoint(*scene.start));
  const CellId goal = free.locate(ExactPoint(*scene.goal));
  if (!free.is_free(start) || !free.is_free(goal)) return std::nullopt;
  answer.thinness = free.thinness(start, goal);
  if (!answer.thinness || answer.thinness->piece < 3 || answer.thinness->junction < 3) return std::nullopt;
  answer.path = find_path(free, *scene.start, *scene.goal, options, monitor);
  if (!answer.path) return std::nullopt;
  answer.status = Answer::Status::kPath;
  answer.start_component = free.component(start);
  answer.goal_component = free.component(goal);
  answer.phases["query"] = watch.lap();
  return result;
}

}  // namespace nef::planner
