// SPDX-License-Identifier: Apache-2.0
//
// With int O + int -R the forbidden positions of solids, their closure is the union of the closed sums, and the closure
// of the complement of that is what a path may use that touches, but leads through no tight passage.
#include "apps/planner/path/partial_answer.h"

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

bool is_of_solids(const Scene& scene) {
  return scene.only_translates() && scene.contact == ContactRule::kAllow && scene.start && scene.goal &&
         is_bounded_solid(scene.robot) && std::all_of(scene.obstacles.begin(), scene.obstacles.end(), is_bounded_solid);
}

}  // namespace

Polyhedron interior_positions(const Scene& scene, const Monitor& watching) {
  const minkowski::MinkowskiOptions options{.monitor = watching};
  const Monitor monitor = watching.quiet();
  const Polyhedron reflected = minkowski::negate(scene.robot, monitor);
  std::vector<Polyhedron> sums;
  for (const Polyhedron& obstacle : scene.obstacles) {
    sums.push_back(minkowski::minkowski_sum(obstacle, reflected, options));
  }
  const Polyhedron free = closure(complement(unite_all(sums, monitor)), monitor);
  return scene.box ? intersect(free, make_box((*scene.box)[0], (*scene.box)[1], monitor), monitor) : free;
}

std::optional<Answer> partial_answer(const Scene& scene, const PathOptions& options, const Monitor& monitor) {
  require_bounded_robot(scene);
  const auto is_mesh = [](const Polyhedron& set) { return set.complex().facets.size() >= kMeshFacets; };
  const bool any = is_mesh(scene.robot) || std::any_of(scene.obstacles.begin(), scene.obstacles.end(), is_mesh);
  return any && is_of_solids(scene) ? interior_answer(scene, options, monitor) : nearby_answer(scene, options, monitor);
}

std::optional<Answer> interior_answer(const Scene& scene, const PathOptions& options, const Monitor& monitor) {
  if (!is_of_solids(scene)) return std::nullopt;
  Stopwatch watch;
  Polyhedron positions = interior_positions(scene, monitor);
  const double sums_s = watch.lap();
  const FreeSpace free(std::move(positions));
  const double cells_s = watch.lap();
  const CellId start = free.locate(ExactPoint(*scene.start));
  const CellId goal = free.locate(ExactPoint(*scene.goal));
  if (!free.is_free(start) || !free.is_free(goal)) return std::nullopt;
  Answer answer;
  answer.thinness = free.thinness(start, goal);
  if (!answer.thinness || answer.thinness->piece < 3 || answer.thinness->junction < 3) return std::nullopt;
  answer.path = find_path(free, *scene.start, *scene.goal, options, monitor);
  if (!answer.path) return std::nullopt;
  answer.status = Answer::Status::kPath;
  answer.start_component = free.component(start);
  answer.goal_component = free.component(goal);
  answer.phases = {{"configuration_space", sums_s}, {"cells", cells_s}, {"query", watch.lap()}};
  return answer;
}

}  // namespace nef::planner
