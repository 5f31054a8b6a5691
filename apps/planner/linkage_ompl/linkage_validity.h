// SPDX-License-Identifier: Apache-2.0
//
// Certified validity of poses and motions of linkages for OMPL's stock space of joint values.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <memory>

#include "apps/planner/linkage/linkage_checker.h"

namespace nef::planner {

/** \brief States are valid if they are in bounds and proved free. The space must be an
    ompl::base::RealVectorStateSpace with a dimension for each joint that has a value. Thread-safe. */
class LinkageStateValidityChecker : public ompl::base::StateValidityChecker {
 public:
  /** \brief Throws InputError if the space is another one. */
  LinkageStateValidityChecker(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const LinkageChecker> checker);
  /** \brief Whether joints at these values are in bounds and proved free. */
  bool isValid(const ompl::base::State* state) const override;
  using ompl::base::StateValidityChecker::isValid;

 private:
  std::shared_ptr<const LinkageChecker> checker_;
};

/** \brief Motions as the space interpolates them, checked as a whole: a motion that is called valid has no colliding
    pose. One that could not be decided within the limits is not valid. The space must be an
    ompl::base::RealVectorStateSpace with a dimension for each joint that has a value. Thread-safe. */
class LinkageMotionValidator : public ompl::base::MotionValidator {
 public:
  /** \brief Throws InputError if the space is another one. */
  LinkageMotionValidator(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const LinkageChecker> checker,
                         CheckLimits limits = CheckLimits::for_planners());
  /** \brief Whether the whole motion is proved free. */
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  /** \brief lastValid is the end of a part of the motion, from s1, that is proved valid. */
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;

 private:
  [[nodiscard]] LinkageVerdict examine(const ompl::base::State* s1, const ompl::base::State* s2,
                                       const CheckLimits& limits) const;

  std::shared_ptr<const LinkageChecker> checker_;
  CheckLimits limits_;
};

}  // namespace nef::planner
