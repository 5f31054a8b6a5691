// SPDX-License-Identifier: Apache-2.0
//
// Certified validity of poses and motions for OMPL's stock spaces of rigid bodies.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <memory>
#include <optional>

#include "apps/planner/rigid/motion_checker.h"

namespace nef::planner {

/** \brief The pose that a state of an SE3StateSpace or an SE2StateSpace stands for, exactly; nothing if a number is not
    finite, or the quaternion is zero.

    A state of SE(2) moves in the plane z = 0 and turns about the z axis; the quaternion is that of the doubles nearest
   to cosine and sine of half the angle. */
std::optional<RigidPose> pose_of(const ompl::base::StateSpace& space, const ompl::base::State* state);

/** \brief Sets a state of an SE3StateSpace to a pose, rounded: the quaternion of a state has length 1. */
void set_pose(const RigidPose& pose, ompl::base::State* state);

/** \brief Exact for the numbers that a state consists of: which states are valid does not depend on rounding. The space
    must be an ompl::base::SE3StateSpace, or an SE2StateSpace. A pose out of the checker's box, or of the space's
   bounds, is not valid. Thread-safe. */
class RigidStateValidityChecker : public ompl::base::StateValidityChecker {
 public:
  /** \brief Throws InputError if the space is neither of the two. */
  RigidStateValidityChecker(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const MotionChecker> checker);
  /** \brief Whether a pose is in bounds and free. */
  bool isValid(const ompl::base::State* state) const override;
  using ompl::base::StateValidityChecker::isValid;

 private:
  std::shared_ptr<const MotionChecker> checker_;
};

/** \brief Motions as the space interpolates them, checked as a whole: a motion that is called valid has no colliding
    pose. One that could not be decided within the limits is not valid. Drop-in for any planner and for SimpleSetup:

        setup.setStateValidityChecker(std::make_shared<RigidStateValidityChecker>(si, checker));
        si->setMotionValidator(std::make_shared<RigidMotionValidator>(si, checker));

    The space must be an ompl::base::SE3StateSpace, or an SE2StateSpace. Thread-safe. */
class RigidMotionValidator : public ompl::base::MotionValidator {
 public:
  /** \brief Throws InputError if the space is neither of the two. */
  RigidMotionValidator(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const MotionChecker> checker,
                       CheckLimits limits = CheckLimits::for_planners());
  /** \brief Whether the whole motion is proved free. */
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  /** \brief lastValid is the end of a part of the motion, from s1, that is proved valid; no more than a 4096th of the
      motion is left out by halving, as long as it is decided. */
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;

 private:
  std::optional<MotionVerdict> examine(const ompl::base::State* s1, const ompl::base::State* s2,
                                       const CheckLimits& limits) const;

  std::shared_ptr<const MotionChecker> checker_;
  CheckLimits limits_;
};

}  // namespace nef::planner
