// SPDX-License-Identifier: Apache-2.0
//
// Exact validity of states and motions for OMPL.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>

#include <memory>
#include <mutex>

#include "apps/planner/clearance.h"
#include "apps/planner/exact_translation_space.h"

namespace nef::planner {

/** \brief State validity by exact point location in the free space.

    Contact with obstacles is valid if the free space says so (it is closed then). Thread-safe. The space
    must be an ExactTranslationSpace. */
class NefStateValidityChecker : public ompl::base::StateValidityChecker {
 public:
  NefStateValidityChecker(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> freeSpace);

  bool isValid(const ompl::base::State* state) const override;
  using ompl::base::StateValidityChecker::isValid;
  /** \brief Distance to the boundary of free space in doubles; negative for invalid states, zero for contact. */
  double clearance(const ompl::base::State* state) const override;
  using ompl::base::StateValidityChecker::clearance;

  const std::shared_ptr<const FreeSpace>& getFreeSpace() const { return freeSpace_; }

 private:
  std::shared_ptr<const FreeSpace> freeSpace_;
  mutable std::once_flag fieldBuilt_;
  mutable std::unique_ptr<ClearanceField> field_;
};

/** \brief Motion validity by an exact query of the whole segment: no resolution, no missed thin walls.

    Works with every planner; the default of OMPL looks at states one percent of the extent apart and
    takes paths through thin walls for valid. Thread-safe but for the counters, as in OMPL. */
class NefMotionValidator : public ompl::base::MotionValidator {
 public:
  NefMotionValidator(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const FreeSpace> freeSpace);

  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  /** \brief lastValid receives the exact point of contact, and its parameter as the nearest double. */
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;

 private:
  std::shared_ptr<const FreeSpace> freeSpace_;
};

}  // namespace nef::planner
