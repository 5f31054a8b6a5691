// SPDX-License-Identifier: Apache-2.0
//
// What our own planners for OMPL share: how they read parameters, and what they say through OMPL.
#pragma once

#include <ompl/base/PlannerStatus.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/config.h>
#include <ompl/util/Console.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace nef::planner {

/// OMPL's parameters are numbers: -1 stands for as many decimals as a way-point has. Throws std::invalid_argument for
/// other negative numbers or more than 300, which makes params().setParam return false.
inline std::optional<unsigned> digits_of_parameter(int digits) {
  if (digits < -1 || digits > 300) {
    throw std::invalid_argument("digits must be -1 (no bound) or 0 to 300, not " + std::to_string(digits));
  }
  if (digits < 0) return std::nullopt;
  return static_cast<unsigned>(digits);
}

inline int parameter_of_digits(const std::optional<unsigned>& digits) {
  return digits ? static_cast<int>(*digits) : -1;
}

/// Says through OMPL's console that a planner makes paths short, if the problem asks for something else.
inline void warn_of_ignored_objective(const ompl::base::ProblemDefinition& problem, const std::string& planner) {
  namespace ob = ompl::base;
  if (!problem.hasOptimizationObjective()) return;
  const ob::OptimizationObjectivePtr& objective = problem.getOptimizationObjective();
  if (dynamic_cast<const ob::PathLengthOptimizationObjective*>(objective.get()) != nullptr) return;
  OMPL_WARN("%s: the optimization objective '%s' is ignored: paths are made short", planner.c_str(),
            objective->getDescription().c_str());
}

/// The status of a proof that there is no path: INFEASIBLE, or ABORT before OMPL 1.6, which has no such status.
inline ompl::base::PlannerStatus infeasible() {
#if defined(OMPL_VERSION_VALUE) && OMPL_VERSION_VALUE >= 1006000
  return ompl::base::PlannerStatus::INFEASIBLE;
#else
  return ompl::base::PlannerStatus::ABORT;
#endif
}

}  // namespace nef::planner
