// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning_ompl/turning_validity.h"

#include <cmath>

#include "nef/number/floor.h"

namespace nef::planner {

namespace ob = ompl::base;

namespace {

const TurningSpace& space_of(const ob::SpaceInformation& si) {
  return *static_cast<const TurningSpace*>(si.getStateSpace().get());
}

bool is_finite_pose(const ob::State* state) {
  const auto* compound = static_cast<const ob::CompoundState*>(state);
  return compound->as<ExactTranslationSpace::StateType>(0)->isFinite() &&
         std::isfinite(compound->as<TurnSpace::StateType>(1)->value);
}

}  // namespace

TurningValidityChecker::TurningValidityChecker(const ob::SpaceInformationPtr& si,
                                               std::shared_ptr<const TurningCollision> collision,
                                               const TurningQuestion& question)
    : ob::StateValidityChecker(si), collision_(std::move(collision)), low_(question.low), high_(question.high) {}

bool TurningValidityChecker::isValid(const ob::State* state) const {
  if (!is_finite_pose(state)) return false;
  const Pose pose = space_of(*si_).pose(state);
  return moved_above(pose.turn, low_) <= high_ && collision_->is_free(pose);
}

TurningMotionValidator::TurningMotionValidator(const ob::SpaceInformationPtr& si,
                                               std::shared_ptr<const TurningCollision> collision,
                                               const TurningQuestion& question, unsigned depth)
    : ob::MotionValidator(si),
      collision_(std::move(collision)),
      low_(question.low),
      high_(question.high),
      depth_(depth) {}

bool TurningMotionValidator::isFree(const ob::State* s1, const ob::State* s2) const {
  if (!is_finite_pose(s1) || !is_finite_pose(s2)) return false;
  const TurningSpace& space = space_of(*si_);
  Pose from = space.pose(s1);
  Pose to = space.pose(s2);
  // The shorter way round, as the space interpolates.
  if (to.turn - from.turn > 2) to.turn -= 4;
  if (from.turn - to.turn > 2) to.turn += 4;
  if (abs(to.turn - from.turn) == 2) return false;  // which way round is not said
  if (high_ - low_ < 4) {
    const Turn moved = moved_above(from.turn, low_) - from.turn;
    from.turn += moved;
    to.turn += moved;
    if (from.turn > high_ || to.turn < low_ || to.turn > high_) return false;
  }
  return collision_->is_free(from, to, depth_);
}

bool TurningMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2) const {
  const bool valid = isFree(s1, s2);
  ++(valid ? valid_ : invalid_);
  return valid;
}

bool TurningMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2,
                                         std::pair<ob::State*, double>& lastValid) const {
  if (checkMotion(s1, s2)) return true;
  constexpr int kParts = 16;
  ob::State* to = si_->allocState();
  int parts = kParts;
  do {
    --parts;
    si_->getStateSpace()->interpolate(s1, s2, parts / double{kParts}, to);
  } while (parts > 0 && !isFree(s1, to));
  lastValid.second = parts / double{kParts};
  if (lastValid.first != nullptr) si_->copyState(lastValid.first, to);
  si_->freeState(to);
  return false;
}

}  // namespace nef::planner
