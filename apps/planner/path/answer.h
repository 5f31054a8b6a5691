// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "apps/planner/free_space/collision.h"
#include "apps/planner/path/path.h"

namespace nef::planner {

/// What is known about a question.
enum class AnswerStatus : std::uint8_t {
  kPath,
  kInfeasible,
  kInvalidStart,
  kInvalidGoal,
  kNoQuestion,
  kBlocked,    ///< a given path leaves free space
  kUndecided,  ///< the search was stopped
};

/// As reports spell it: "path", "infeasible", "invalid_start", "invalid_goal", "free_space", "blocked", "undecided".
inline const char* status_name(AnswerStatus status) {
  constexpr std::array kNames{"path",       "infeasible", "invalid_start", "invalid_goal",
                              "free_space", "blocked",    "undecided"};
  return kNames[static_cast<std::size_t>(status)];
}

/// What came out of a question.
struct Answer {
  using Status = AnswerStatus;
  Status status = Status::kNoQuestion;
  std::optional<ExactPath> path;
  std::optional<Thinness> thinness;            ///< the best T and J of any path from start to goal
  std::optional<Collision> collision;          ///< of an invalid start or goal, or of a blocked path
  std::optional<std::size_t> blocked_segment;  ///< of a given path: the first segment that leaves free space
  std::uint32_t start_component = 0;           ///< infeasible: the two components
  std::uint32_t goal_component = 0;
  std::map<std::string, double> phases;  ///< seconds
};

}  // namespace nef::planner
