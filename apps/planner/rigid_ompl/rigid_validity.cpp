// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid_ompl/rigid_validity.h"

#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>

#include <cmath>
#include <initializer_list>

#include "apps/planner/rigid_search/pose_metric.h"
#include "nef/base/error.h"

namespace nef::planner {

namespace ob = ompl::base;

namespace {

bool all_finite(std::initializer_list<double> values) {
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

std::optional<RigidPose> pose_of_se3(const ob::SE3StateSpace::StateType& state) {
  const ob::SO3StateSpace::StateType& q = state.rotation();
  if (!all_finite({state.getX(), state.getY(), state.getZ(), q.w, q.x, q.y, q.z})) return std::nullopt;
  if (q.w == 0 && q.x == 0 && q.y == 0 && q.z == 0) return std::nullopt;
  return RigidPose{{exact_rational(state.getX()), exact_rational(state.getY()), exact_rational(state.getZ())},
                   {exact_rational(q.w), exact_rational(q.x), exact_rational(q.y), exact_rational(q.z)}};
}

std::optional<RigidPose> pose_of_se2(const ob::SE2StateSpace::StateType& state) {
  if (!all_finite({state.getX(), state.getY(), state.getYaw()})) return std::nullopt;
  return RigidPose{{exact_rational(state.getX()), exact_rational(state.getY()), 0},
                   {exact_rational(std::cos(state.getYaw() / 2)), 0, 0, exact_rational(std::sin(state.getYaw() / 2))}};
}

void require_rigid(const ob::SpaceInformation& si) {
  const ob::StateSpace* space = si.getStateSpace().get();
  if (dynamic_cast<const ob::SE3StateSpace*>(space) == nullptr &&
      dynamic_cast<const ob::SE2StateSpace*>(space) == nullptr) {
    throw InputError("rigid bodies need an SE3StateSpace or an SE2StateSpace");
  }
}

}  // namespace

std::optional<RigidPose> pose_of(const ob::StateSpace& space, const ob::State* state) {
  if (dynamic_cast<const ob::SE3StateSpace*>(&space) != nullptr) {
    return pose_of_se3(*state->as<ob::SE3StateSpace::StateType>());
  }
  return pose_of_se2(*state->as<ob::SE2StateSpace::StateType>());
}

void set_pose(const RigidPose& pose, ob::State* state) {
  auto& to = *state->as<ob::SE3StateSpace::StateType>();
  to.setXYZ(nearest_double(pose.position[0]), nearest_double(pose.position[1]), nearest_double(pose.position[2]));
  const Eigen::Quaterniond q = PoseMetric::rounded(pose.quaternion);
  ob::SO3StateSpace::StateType& rotation = to.rotation();
  rotation.w = q.w();
  rotation.x = q.x();
  rotation.y = q.y();
  rotation.z = q.z();
}

RigidStateValidityChecker::RigidStateValidityChecker(const ob::SpaceInformationPtr& si,
                                                     std::shared_ptr<const MotionChecker> checker)
    : ob::StateValidityChecker(si), checker_(std::move(checker)) {
  require_rigid(*si);
}

bool RigidStateValidityChecker::isValid(const ob::State* state) const {
  if (!si_->satisfiesBounds(state)) return false;
  const std::optional<RigidPose> pose = pose_of(*si_->getStateSpace(), state);
  return pose && checker_->check(*pose).status == MotionVerdict::Status::kFree;
}

RigidMotionValidator::RigidMotionValidator(const ob::SpaceInformationPtr& si,
                                           std::shared_ptr<const MotionChecker> checker, CheckLimits limits)
    : ob::MotionValidator(si), checker_(std::move(checker)), limits_(limits) {
  limits_.keep_pose = false;
  require_rigid(*si);
}

std::optional<MotionVerdict> RigidMotionValidator::examine(const ob::State* s1, const ob::State* s2,
                                                           const CheckLimits& limits) const {
  const std::optional<RigidPose> from = pose_of(*si_->getStateSpace(), s1);
  const std::optional<RigidPose> to = pose_of(*si_->getStateSpace(), s2);
  if (!from || !to) return std::nullopt;
  return checker_->check(RigidMotion(*from, *to, MotionTiming::kSlerp), limits);
}

bool RigidMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2) const {
  bool valid = si_->satisfiesBounds(s2);
  if (valid) {
    const std::optional<MotionVerdict> verdict = examine(s1, s2, limits_);
    valid = verdict && verdict->status == MotionVerdict::Status::kFree;
  }
  ++(valid ? valid_ : invalid_);
  return valid;
}

bool RigidMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2,
                                       std::pair<ob::State*, double>& lastValid) const {
  if (checkMotion(s1, s2)) return true;
  CheckLimits limits = limits_;
  limits.in_order = true;
  const std::optional<MotionVerdict> verdict = examine(s1, s2, limits);
  double time = 0;
  if (verdict) {
    const std::optional<RigidPose> from = pose_of(*si_->getStateSpace(), s1);
    const std::optional<RigidPose> to = pose_of(*si_->getStateSpace(), s2);
    const RigidMotion motion(*from, *to, MotionTiming::kSlerp);
    // A state at a rounded time must lie in what was proved free.
    time = std::max(0.0, motion.time_of(verdict->free_until) - 2 * RigidMotion::kTimeError);
  }
  lastValid.second = time;
  if (lastValid.first != nullptr) si_->getStateSpace()->interpolate(s1, s2, time, lastValid.first);
  return false;
}

}  // namespace nef::planner
