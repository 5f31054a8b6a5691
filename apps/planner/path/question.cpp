// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/question.h"

#include "nef/base/error.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::planner {

Problem::Problem(Scene scene, const Monitor& monitor) : scene_(std::move(scene)) {
  Stopwatch watch;
  Polyhedron free = free_positions(scene_, monitor);
  phases_["configuration_space"] = watch.lap();
  monitor.tell_progress("roadmap", 0, 0);
  free_ = std::make_shared<const FreeSpace>(std::move(free));
  phases_["cells"] = watch.lap();
}

Problem::Problem(Scene scene, Polyhedron free) : scene_(std::move(scene)) {
  Stopwatch watch;
  free_ = std::make_shared<const FreeSpace>(std::move(free));
  phases_["cells"] = watch.lap();
}

Answer Problem::solve(const PathOptions& options, const Monitor& monitor) const {
  if (!scene_.start) throw InputError(scene_.name + ": the scene has no start; add one, or use --start x,y,z");
  if (!scene_.goal) throw InputError(scene_.name + ": the scene has no goal; add one, or use --goal x,y,z");
  return solve(*scene_.start, *scene_.goal, options, monitor);
}

Answer Problem::solve(const Rational3& start, const Rational3& goal, const PathOptions& options,
                      const Monitor& monitor) const {
  Stopwatch watch;
  Answer answer;
  answer.phases = phases_;
  const CellId start_cell = free_->locate(ExactPoint(start));
  const CellId goal_cell = free_->locate(ExactPoint(goal));
  if (!free_->is_free(start_cell) || !free_->is_free(goal_cell)) {
    const bool at_start = !free_->is_free(start_cell);
    answer.status = at_start ? Answer::Status::kInvalidStart : Answer::Status::kInvalidGoal;
    answer.collision = find_collision(scene_, at_start ? start : goal, monitor);
    NEF_ASSERT(answer.collision.has_value());
    answer.phases["query"] = watch.lap();
    return answer;
  }
  answer.start_component = free_->component(start_cell);
  answer.goal_component = free_->component(goal_cell);
  answer.thinness = free_->thinness(start_cell, goal_cell);
  const double roadmap_before = free_->roadmap_seconds();
  answer.path = find_path(*free_, start, goal, options, monitor);
  answer.status = answer.path ? Answer::Status::kPath : Answer::Status::kInfeasible;
  const double roadmap = free_->roadmap_seconds() - roadmap_before;
  if (roadmap > 0) answer.phases["roadmap"] = roadmap;
  answer.phases["query"] = watch.lap() - roadmap;
  return answer;
}

std::optional<Answer> Problem::invalid_end(const Scene& scene, const Rational3& start, const Rational3& goal,
                                           const Monitor& monitor) {
  require_no_rotation(scene);
  require_bounded_robot(scene);
  Stopwatch watch;
  Answer answer;
  for (const auto& [position, status] :
       {std::pair(&start, Answer::Status::kInvalidStart), std::pair(&goal, Answer::Status::kInvalidGoal)}) {
    answer.collision = find_collision(scene, *position, monitor);
    if (!answer.collision) continue;
    answer.status = status;
    answer.phases["query"] = watch.lap();
    return answer;
  }
  return std::nullopt;
}

Answer Problem::check(const std::vector<Rational3>& points, const Monitor& monitor) const {
  Stopwatch watch;
  Answer answer;
  answer.phases = phases_;
  answer.path = describe_path(*free_, points);
  answer.status = answer.path ? Answer::Status::kPath : Answer::Status::kBlocked;
  for (std::size_t i = 0; i < points.size() && !answer.path; ++i) {
    const Rational3& next = points[std::min(i + 1, points.size() - 1)];
    const std::optional<Rational3> hit = first_blocked_position(*free_, points[i], next);
    if (!hit) continue;
    answer.blocked_segment = i;
    answer.collision = find_collision(scene_, *hit, monitor);
    break;
  }
  answer.phases["query"] = watch.lap();
  return answer;
}

}  // namespace nef::planner
