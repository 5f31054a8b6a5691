// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/ompl/nef_validity.h"

#include <ompl/base/SpaceInformation.h>

#include <cmath>

#include "apps/planner/free_space/segments.h"
#include "apps/planner/partition/segment_walk.h"

namespace nef::planner {

namespace ob = ompl::base;
using StateType = ExactTranslationSpace::StateType;

namespace {

bool is_finite(const ob::State* state) { return static_cast<const StateType*>(state)->isFinite(); }

}  // namespace

NefStateValidityChecker::NefStateValidityChecker(const ob::SpaceInformationPtr& si,
                                                 std::shared_ptr<const FreeSpace> freeSpace,
                                                 ob::StateValidityCheckerPtr further)
    : ob::StateValidityChecker(si), freeSpace_(std::move(freeSpace)), further_(std::move(further)) {
  specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::APPROXIMATE;
}

bool NefStateValidityChecker::isValid(const ob::State* state) const {
  return is_finite(state) && freeSpace_->is_free(static_cast<const StateType*>(state)->point()) &&
         (!further_ || further_->isValid(state));
}

double NefStateValidityChecker::clearance(const ob::State* state) const {
  if (!is_finite(state)) return -HUGE_VAL;
  std::call_once(fieldBuilt_, [this] { field_ = std::make_unique<ClearanceField>(*freeSpace_); });
  const auto* exact = static_cast<const StateType*>(state);
  const ExactPoint point = exact->point();
  const CellId cell = freeSpace_->locate(point);
  if (freeSpace_->is_free(cell)) {
    // A thinner cell than a volume is contact, whatever the doubles say.
    return freeSpace_->cells().dimension(cell) < 3 ? 0.0 : field_->distance(to_vector(point.approximate()));
  }
  return -field_->distance(to_vector(point.approximate()));
}

NefMotionValidator::NefMotionValidator(const ob::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> freeSpace,
                                       ob::MotionValidatorPtr further)
    : ob::MotionValidator(si), freeSpace_(std::move(freeSpace)), further_(std::move(further)), atSteps_(si) {}

const ob::MotionValidator* NefMotionValidator::furtherChecks() const {
  if (further_) return further_.get();
  return hasFurtherChecks(*si_) ? &atSteps_ : nullptr;
}

bool NefMotionValidator::isFree(const ob::State* s1, const ob::State* s2) const {
  if (!is_finite(s1) || !is_finite(s2)) return false;
  const ExactPoint a = static_cast<const StateType*>(s1)->point();
  const ExactPoint b = static_cast<const StateType*>(s2)->point();
  if (si_->equalStates(s1, s2)) return freeSpace_->is_free(b);
  bool free = true;
  walk_segment(freeSpace_->tree(), a, b,
               [&](const SegmentPart& part) { return free = freeSpace_->is_free(part.cell); });
  return free;
}

bool NefMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2) const {
  const ob::MotionValidator* further = furtherChecks();
  const bool valid = isFree(s1, s2) && (further == nullptr || further->checkMotion(s1, s2));
  ++(valid ? valid_ : invalid_);
  return valid;
}

void NefMotionValidator::findLastFree(const ob::State* s1, const ob::State* s2,
                                      std::pair<ob::State*, double>& lastValid) const {
  lastValid.second = 0;
  std::optional<Contact> contact;
  if (is_finite(s1) && is_finite(s2) && !si_->equalStates(s1, s2)) {
    const ExactPoint a = static_cast<const StateType*>(s1)->point();
    const ExactPoint b = static_cast<const StateType*>(s2)->point();
    contact = first_contact(*freeSpace_, a, b);
    if (contact) lastValid.second = nearest_double(contact->last_free);
    if (contact && contact->last_free > 0 && lastValid.first != nullptr) {
      const Rational3 exact = ExactSegment(freeSpace_->tree().planes(), a, b).point(contact->last_free);
      static_cast<StateType*>(lastValid.first)->setExact(exact);
      return;
    }
  }
  if (lastValid.first != nullptr) si_->copyState(lastValid.first, s1);
}

bool NefMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2,
                                     std::pair<ob::State*, double>& lastValid) const {
  const bool free = isFree(s1, s2);
  if (!free) findLastFree(s1, s2, lastValid);
  const ob::MotionValidator* further = furtherChecks();
  if (further == nullptr || !is_finite(s1) || !is_finite(s2)) {
    ++(free ? valid_ : invalid_);
    return free;
  }
  // The further checker may object earlier. It is asked along the whole motion, so that its steps do not depend on
  // ours.
  ob::State* earlier = lastValid.first != nullptr ? si_->allocState() : nullptr;
  std::pair<ob::State*, double> at(earlier, 0.0);
  const bool accepted = further->checkMotion(s1, s2, at);
  if (!accepted && (free || at.second < lastValid.second)) {
    lastValid.second = at.second;
    if (earlier != nullptr) si_->copyState(lastValid.first, earlier);
  }
  if (earlier != nullptr) si_->freeState(earlier);
  ++(free && accepted ? valid_ : invalid_);
  return free && accepted;
}

bool hasFurtherChecks(const ob::SpaceInformation& si) {
  const auto* checker = dynamic_cast<const NefStateValidityChecker*>(si.getStateValidityChecker().get());
  if (checker == nullptr || checker->getFurtherChecker() != nullptr) return true;
  const auto* validator = dynamic_cast<const NefMotionValidator*>(si.getMotionValidator().get());
  return validator != nullptr && validator->getFurtherValidator() != nullptr;
}

}  // namespace nef::planner
