// SPDX-License-Identifier: Apache-2.0
//
// Exact checks for OMPL that know how long they took.
#pragma once

#include <chrono>
#include <ctime>

#include "apps/planner/ompl/nef_validity.h"

namespace nef::planner {

/// Seconds of the wall clock, since OMPL's limits are of the wall clock too.
inline double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor seconds of this program, for what is ours: a busy machine does not count.
inline double processor() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Shared by the checkers of one run.
struct CheckTime {
  double seconds = 0;
};

class TimedState : public NefStateValidityChecker {
 public:
  TimedState(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> free, CheckTime& time)
      : NefStateValidityChecker(si, std::move(free)), time_(time) {}
  using NefStateValidityChecker::isValid;
  bool isValid(const ompl::base::State* state) const override {
    const double begin = now();
    const bool valid = NefStateValidityChecker::isValid(state);
    time_.seconds += now() - begin;
    return valid;
  }

 private:
  CheckTime& time_;
};

class TimedMotion : public NefMotionValidator {
 public:
  TimedMotion(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> free, CheckTime& time)
      : NefMotionValidator(si, std::move(free)), time_(time) {}
  using NefMotionValidator::checkMotion;
  bool checkMotion(const ompl::base::State* a, const ompl::base::State* b) const override {
    const double begin = now();
    const bool valid = NefMotionValidator::checkMotion(a, b);
    time_.seconds += now() - begin;
    return valid;
  }

 private:
  CheckTime& time_;
};

}  // namespace nef::planner
