// SPDX-License-Identifier: Apache-2.0
//
// Everything that OMPL's planners need for a rigid body, in one object.
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include <memory>
#include <vector>

#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid/rigid_question.h"
#include "apps/planner/rigid_ompl/sliced_space.h"

namespace nef::planner {

/** \brief A SimpleSetup for the question of a scene whose robot turns freely: OMPL's SE3StateSpace, with samples from
    slices as well, exact validity of states, certified motions, start and goal. Any planner of OMPL may be set; without
    one OMPL chooses.

    States are doubles, so the start and the goal that a planner sees are rounded: a robot that touches something there
    may collide after rounding, and then the planner finds nothing: ask getSpaceInformation()->isValid. */
class SE3Planning : public ompl::geometric::SimpleSetup {
 public:
  /** \brief `checker` must be that of the scene. Throws InputError as rigid_question_of does. */
  SE3Planning(const Scene& scene, std::shared_ptr<const MotionChecker> checker);

  /** \brief The way-points of the solution that there must be, the exact start and goal of the scene at its ends. */
  std::vector<RigidPose> getSolutionPoses() const;

  /** \brief The state space. */
  SlicedSpace& space() const { return *static_cast<SlicedSpace*>(si_->getStateSpace().get()); }

 private:
  RigidQuestion question_;
};

}  // namespace nef::planner
