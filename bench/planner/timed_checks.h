// SPDX-License-Identifier: Apache-2.0
//
// Exact checks for OMPL that know how long they took: on the wall, since OMPL's limits are of that clock, too.
#pragma once

#include "apps/planner/ompl/nef_validity.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::planner {

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
    const Stopwatch watch;
    const bool valid = NefStateValidityChecker::isValid(state);
    time_.seconds += watch.seconds();
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
    const Stopwatch watch;
    const bool valid = NefMotionValidator::checkMotion(a, b);
    time_.seconds += watch.seconds();
    return valid;
  }

 private:
  CheckTime& time_;
};

}  // namespace nef::planner
