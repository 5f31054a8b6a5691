// SPDX-License-Identifier: Apache-2.0
//
// Exact validity of states and motions for OMPL.
#pragma once

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>

#include <memory>
#include <mutex>

#include "apps/planner/free_space/clearance.h"
#include "apps/planner/ompl/exact_translation_space.h"

namespace nef::planner {

/** \brief State validity by exact point location in the free space.

    Contact with obstacles is valid if the free space says so (it is closed then). A further checker, say one of
    the user's, may be asked as well: then a state is valid if both say so, and only the part about the obstacles is
    exact. Thread-safe, if the further checker is. The space must be an ExactTranslationSpace. */
class NefStateValidityChecker : public ompl::base::StateValidityChecker {
 public:
  NefStateValidityChecker(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> freeSpace,
                          ompl::base::StateValidityCheckerPtr further = nullptr);

  bool isValid(const ompl::base::State* state) const override;
  using ompl::base::StateValidityChecker::isValid;
  /** \brief Distance to the boundary of free space in doubles; negative for invalid states, zero for contact. */
  double clearance(const ompl::base::State* state) const override;
  using ompl::base::StateValidityChecker::clearance;

  const std::shared_ptr<const FreeSpace>& getFreeSpace() const { return freeSpace_; }
  /** \brief The checker that is asked as well; may be null. */
  const ompl::base::StateValidityCheckerPtr& getFurtherChecker() const { return further_; }

 private:
  std::shared_ptr<const FreeSpace> freeSpace_;
  ompl::base::StateValidityCheckerPtr further_;
  mutable std::once_flag fieldBuilt_;
  mutable std::unique_ptr<ClearanceField> field_;
};

/** \brief Motion validity by an exact query of the whole segment: no resolution, no missed thin walls.

    Works with every planner; the default of OMPL looks at states one percent of the extent apart and
    takes paths through thin walls for valid. If the state validity checker asks a further one, that is asked at
    OMPL's resolution; a further motion validator may be asked as well. Thread-safe but for the counters, as in OMPL. */
class NefMotionValidator : public ompl::base::MotionValidator {
 public:
  NefMotionValidator(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> freeSpace,
                     ompl::base::MotionValidatorPtr further = nullptr);

  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  /** \brief lastValid receives the exact point of contact, and its parameter as the nearest double. */
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;

  const std::shared_ptr<const FreeSpace>& getFreeSpace() const { return freeSpace_; }
  /** \brief The validator that is asked as well; may be null. */
  const ompl::base::MotionValidatorPtr& getFurtherValidator() const { return further_; }

 private:
  bool isFree(const ompl::base::State* s1, const ompl::base::State* s2) const;
  // What else is to be asked; null if nothing is.
  const ompl::base::MotionValidator* furtherChecks() const;
  void findLastFree(const ompl::base::State* s1, const ompl::base::State* s2,
                    std::pair<ompl::base::State*, double>& lastValid) const;

  std::shared_ptr<const FreeSpace> freeSpace_;
  ompl::base::MotionValidatorPtr further_;
  ompl::base::DiscreteMotionValidator atSteps_;  ///< for a further checker of states
};

/** \brief True if validity depends on more than the free space. */
bool hasFurtherChecks(const ompl::base::SpaceInformation& si);

}  // namespace nef::planner
