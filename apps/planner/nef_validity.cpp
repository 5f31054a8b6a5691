// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/nef_validity.h"

#include <ompl/base/SpaceInformation.h>

#include <cmath>

#include "apps/planner/segment_walk.h"
#include "apps/planner/segments.h"

namespace nef::planner {

namespace ob = ompl::base;
using StateType = ExactTranslationSpace::StateType;

namespace {

bool is_finite(const ob::State* state) {
  const double* values = static_cast<const StateType*>(state)->values;
  return std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
}

}  // namespace

NefStateValidityChecker::NefStateValidityChecker(const ob::SpaceInformationPtr& si,
                                                 std::shared_ptr<const FreeSpace> freeSpace)
    : ob::StateValidityChecker(si), freeSpace_(std::move(freeSpace)) {
  specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::APPROXIMATE;
}

bool NefStateValidityChecker::isValid(const ob::State* state) const {
  return is_finite(state) && freeSpace_->is_free(static_cast<const StateType*>(state)->point());
}

double NefStateValidityChecker::clearance(const ob::State* state) const {
  if (!is_finite(state)) return -HUGE_VAL;
  std::call_once(fieldBuilt_, [this] { field_ = std::make_unique<ClearanceField>(*freeSpace_); });
  const auto* exact = static_cast<const StateType*>(state);
  const ExactPoint point = exact->point();
  const CellId cell = freeSpace_->locate(point);
  if (freeSpace_->is_free(cell)) {
    // A thinner cell than a volume is contact, whatever the doubles say.
    return freeSpace_->cells().dimension(cell) < 3 ? 0.0 : field_->distance(point.approximate());
  }
  return -field_->distance(point.approximate());
}

NefMotionValidator::NefMotionValidator(const ob::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> freeSpace)
    : ob::MotionValidator(si), freeSpace_(std::move(freeSpace)) {}

bool NefMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2) const {
  if (!is_finite(s1) || !is_finite(s2)) {
    ++invalid_;
    return false;
  }
  const ExactPoint a = static_cast<const StateType*>(s1)->point();
  const ExactPoint b = static_cast<const StateType*>(s2)->point();
  bool valid = true;
  if (si_->equalStates(s1, s2)) {
    valid = freeSpace_->is_free(b);
  } else {
    walk_segment(freeSpace_->tree(), a, b,
                 [&](const SegmentPart& part) { return valid = freeSpace_->is_free(part.cell); });
  }
  ++(valid ? valid_ : invalid_);
  return valid;
}

bool NefMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2,
                                     std::pair<ob::State*, double>& lastValid) const {
  if (checkMotion(s1, s2)) return true;
  lastValid.second = 0;
  if (!is_finite(s1) || !is_finite(s2)) {
    if (lastValid.first != nullptr) si_->copyState(lastValid.first, s1);
    return false;
  }
  const ExactPoint a = static_cast<const StateType*>(s1)->point();
  const ExactPoint b = static_cast<const StateType*>(s2)->point();
  std::optional<Contact> contact;
  if (!si_->equalStates(s1, s2)) contact = first_contact(*freeSpace_, a, b);
  if (contact) lastValid.second = nearest_double(contact->last_free);
  if (lastValid.first == nullptr) return false;
  if (contact && contact->last_free > 0) {
    const Rational3 exact = ExactSegment(freeSpace_->tree().planes(), a, b).point(contact->last_free);
    static_cast<StateType*>(lastValid.first)->setExact(exact);
  } else {
    si_->copyState(lastValid.first, s1);
  }
  return false;
}

}  // namespace nef::planner
