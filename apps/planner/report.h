// SPDX-License-Identifier: Apache-2.0
//
// Answers of the planner as data: JSON, text, OMPL's path matrix.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/planner/path.h"
#include "apps/planner/scene.h"

namespace nef::planner {

/// What came out of a question.
struct Answer {
  enum class Status : std::uint8_t { kPath, kInfeasible, kInvalidStart, kInvalidGoal, kNoQuestion, kBlocked };
  Status status = Status::kNoQuestion;
  std::optional<ExactPath> path;
  std::optional<Thinness> thinness;            ///< the best T and J of any path from start to goal
  std::optional<Collision> collision;          ///< of an invalid start or goal, or of a blocked path
  std::optional<std::size_t> blocked_segment;  ///< of a given path: the first segment that leaves free space
  std::uint32_t start_component = 0;           ///< infeasible: the two components
  std::uint32_t goal_component = 0;
  std::map<std::string, double> phases;  ///< seconds
};

/// Exit code of the command: 0 path (or no question), 1 infeasible (or a given path is blocked), 3 invalid start or
/// goal.
int exit_code(const Answer& answer);
/// "path", "infeasible", "invalid_start", "invalid_goal", "free_space", "blocked".
std::string status_name(Answer::Status status);

/// All keys of the JSON report (see docs and `planner --help`).
nlohmann::json to_json(const Answer& answer, const Scene& scene, const FreeSpace& free);
/// The tight passages alone.
nlohmann::json passages_json(const FreeSpace& free);
/// The same for people.
std::string passages_text(const FreeSpace& free);

}  // namespace nef::planner
