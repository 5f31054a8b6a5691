// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/linkage_ompl/linkage_validity.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "nef/base/error.h"

namespace nef::planner {

namespace ob = ompl::base;

namespace {

std::span<const double> values_of(const LinkageChecker& checker, const ob::State* state) {
  return {state->as<ob::RealVectorStateSpace::StateType>()->values, checker.linkage().dimension()};
}

void require_joint_space(const ob::SpaceInformation& si, const LinkageChecker& checker) {
  const ob::StateSpace* space = si.getStateSpace().get();
  if (dynamic_cast<const ob::RealVectorStateSpace*>(space) == nullptr ||
      space->getDimension() != checker.linkage().dimension()) {
    throw InputError("this linkage needs a RealVectorStateSpace of " + std::to_string(checker.linkage().dimension()) +
                     " dimensions");
  }
}

bool are_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

LinkageStateValidityChecker::LinkageStateValidityChecker(const ob::SpaceInformationPtr& si,
                                                         std::shared_ptr<const LinkageChecker> checker)
    : ob::StateValidityChecker(si), checker_(std::move(checker)) {
  require_joint_space(*si, *checker_);
}

bool LinkageStateValidityChecker::isValid(const ob::State* state) const {
  const std::span<const double> values = values_of(*checker_, state);
  return are_finite(values) && si_->satisfiesBounds(state) &&
         checker_->check(values).status == MotionVerdict::Status::kFree;
}

LinkageMotionValidator::LinkageMotionValidator(const ob::SpaceInformationPtr& si,
                                               std::shared_ptr<const LinkageChecker> checker, CheckLimits limits)
    : ob::MotionValidator(si), checker_(std::move(checker)), limits_(limits) {
  require_joint_space(*si, *checker_);
}

LinkageVerdict LinkageMotionValidator::examine(const ob::State* s1, const ob::State* s2,
                                               const CheckLimits& limits) const {
  const std::span<const double> from = values_of(*checker_, s1);
  const std::span<const double> to = values_of(*checker_, s2);
  if (are_finite(from) && are_finite(to)) return checker_->check(from, to, limits);
  LinkageVerdict none;
  none.status = MotionVerdict::Status::kUndecided;
  none.free_until = 0;
  return none;
}

bool LinkageMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2) const {
  const bool valid = si_->satisfiesBounds(s2) && examine(s1, s2, limits_).status == MotionVerdict::Status::kFree;
  ++(valid ? valid_ : invalid_);
  return valid;
}

bool LinkageMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2,
                                         std::pair<ob::State*, double>& lastValid) const {
  if (checkMotion(s1, s2)) return true;
  CheckLimits limits = limits_;
  limits.in_order = true;
  const double time = examine(s1, s2, limits).free_until;
  // A motion may be free up to bounds that it leaves: not more than the state before them is known then.
  lastValid.second = std::min(time, 1 - 0x1p-20);
  if (lastValid.first != nullptr) si_->getStateSpace()->interpolate(s1, s2, lastValid.second, lastValid.first);
  return false;
}

}  // namespace nef::planner
