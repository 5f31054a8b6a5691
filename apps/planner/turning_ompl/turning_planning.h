// SPDX-License-Identifier: Apache-2.0
//
// Everything needed to plan for a robot that turns, in one object.
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include "apps/planner/turning_ompl/turning_planner.h"
#include "apps/planner/turning_ompl/turning_validity.h"

namespace nef::planner {

/** \brief A SimpleSetup for the question of a scene with a rotation: a TurningSpace, validity of states and motions
    without samples in between, start and goal, and TurningPlanner as the default planner. Any planner of OMPL may take
    its place. */
class TurningPlanning : public ompl::geometric::SimpleSetup {
 public:
  /** \brief Throws InputError as question_of and TurningCollision do. Without a box in the scene the state space is
      bounded by the obstacles, start and goal with twice the robot's reach to spare. */
  explicit TurningPlanning(const Scene& scene);

  /** \brief The scene that was given. */
  const Scene& getScene() const { return scene_; }
  /** \brief Robot, obstacles, start and goal as the planner takes them. */
  const TurningQuestion& getQuestion() const { return question_; }
  /** \brief The default planner, if it is in use. */
  TurningPlanner* getTurningPlanner() const { return dynamic_cast<TurningPlanner*>(planner_.get()); }
  /** \brief The state space. */
  const TurningSpace& space() const { return *static_cast<const TurningSpace*>(si_->getStateSpace().get()); }

 private:
  Scene scene_;
  TurningQuestion question_;
};

}  // namespace nef::planner
