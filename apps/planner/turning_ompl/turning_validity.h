// SPDX-License-Identifier: Apache-2.0
//
// Validity of poses and motions of a robot that turns, for OMPL.
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <memory>

#include "apps/planner/turning/turning_collision.h"
#include "apps/planner/turning_ompl/turning_space.h"

namespace nef::planner {

/** \brief Exact for the turn that a state stands for (see TurnSpace), which must be in the question's range. The space
    must be a TurningSpace. Thread-safe. */
class TurningValidityChecker : public ompl::base::StateValidityChecker {
 public:
  TurningValidityChecker(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const TurningCollision> collision,
                         const TurningQuestion& question);
  bool isValid(const ompl::base::State* state) const override;
  using ompl::base::StateValidityChecker::isValid;

 private:
  std::shared_ptr<const TurningCollision> collision_;
  Turn low_;
  Turn high_;
};

/** \brief Exact for motions at one angle; a motion that turns is valid only if all of it is surely free (it is cut up
   to `depth` times, see TurningCollision), so what is called valid is free. Nothing is missed between samples. */
class TurningMotionValidator : public ompl::base::MotionValidator {
 public:
  TurningMotionValidator(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const TurningCollision> collision,
                         const TurningQuestion& question, unsigned depth = 8);
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  /** \brief lastValid is the farthest end of 16 equal parts up to which the motion is valid. */
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;

 private:
  bool isFree(const ompl::base::State* s1, const ompl::base::State* s2) const;

  std::shared_ptr<const TurningCollision> collision_;
  Turn low_;
  Turn high_;
  unsigned depth_;
};

}  // namespace nef::planner
