// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "apps/planner/free_space/collision.h"
#include "apps/planner/path/path.h"

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

}  // namespace nef::planner
