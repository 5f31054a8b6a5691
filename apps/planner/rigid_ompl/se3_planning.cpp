// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid_ompl/se3_planning.h"

#include "apps/planner/ompl/position_bounds.h"
#include "apps/planner/rigid_ompl/rigid_validity.h"

namespace nef::planner {

namespace ob = ompl::base;

namespace {

std::shared_ptr<SlicedSpace> space_of(const Scene& scene, std::shared_ptr<const MotionChecker> checker) {
  auto space = std::make_shared<SlicedSpace>(std::make_shared<SlicePool>(scene, std::move(checker)));
  space->setBounds(position_bounds(scene));
  return space;
}

}  // namespace

SE3Planning::SE3Planning(const Scene& scene, std::shared_ptr<const MotionChecker> checker)
    : ompl::geometric::SimpleSetup(space_of(scene, checker)), question_(rigid_question_of(scene)) {
  setStateValidityChecker(std::make_shared<RigidStateValidityChecker>(si_, checker));
  si_->setMotionValidator(std::make_shared<RigidMotionValidator>(si_, std::move(checker)));
  ob::ScopedState<> start(si_);
  ob::ScopedState<> goal(si_);
  set_pose(question_.start, start.get());
  set_pose(question_.goal, goal.get());
  setStartAndGoalStates(start, goal);
}

std::vector<RigidPose> SE3Planning::getSolutionPoses() const {
  const std::vector<ob::State*>& states = getSolutionPath().getStates();
  std::vector<RigidPose> poses{question_.start};
  for (std::size_t i = 1; i + 1 < states.size(); ++i) poses.push_back(*pose_of(*si_->getStateSpace(), states[i]));
  poses.push_back(question_.goal);
  return poses;
}

}  // namespace nef::planner
