// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning_ompl/turning_planner.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <ostream>

#include "apps/planner/ompl/own_planners.h"
#include "nef/number/floor.h"

namespace nef::planner {

namespace ob = ompl::base;

TurningImpossibility::TurningImpossibility(const ob::SpaceInformationPtr& si, Scene scene, TurningQuestion question,
                                           TurningProof proof)
    : ob::SolutionNonExistenceProof(si),
      scene_(std::move(scene)),
      question_(std::move(question)),
      proof_(std::move(proof)) {}

bool TurningImpossibility::verify() const { return !complaint_about(proof_, scene_, question_); }

void TurningImpossibility::print(std::ostream& out) const {
  out << "No path at any angle: start and goal are apart in " << proof_.cells.size() << " cells of angles.\n";
}

TurningPlanner::TurningPlanner(const ob::SpaceInformationPtr& si, Scene scene, TurningQuestion question)
    : ob::Planner(si, "TurningPlanner"), scene_(std::move(scene)), question_(std::move(question)) {
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  specs_.provingSolutionNonExistence = true;
  declareParam<unsigned int>("max_cells", this, &TurningPlanner::setMaxCells, &TurningPlanner::getMaxCells,
                             "1:1:100000");
  declareParam<int>("digits", this, &TurningPlanner::setDigits, &TurningPlanner::getDigits, "-1:1:300");
  addPlannerProgressProperty("cells INTEGER", [this] { return std::to_string(cells_); });
}

void TurningPlanner::clear() {
  ob::Planner::clear();
  answer_.reset();
  cells_ = 0;
}

ob::PlannerStatus TurningPlanner::solve(const ob::PlannerTerminationCondition& ptc) {
  checkValidity();
  warn_of_ignored_objective(*pdef_, name_);
  const auto& space = *static_cast<const TurningSpace*>(si_->getStateSpace().get());
  const auto into_range = [&](Pose pose) {
    pose.turn = moved_above(pose.turn, question_.low);
    return pose;
  };
  const ob::State* start = pis_.nextStart();
  if (start == nullptr) return ob::PlannerStatus::INVALID_START;
  const ob::State* goal = pis_.nextGoal(ptc);
  if (goal == nullptr) return ob::PlannerStatus::INVALID_GOAL;
  question_.start = into_range(space.pose(start));
  question_.goal = into_range(space.pose(goal));
  TurningLimits limits;
  limits.max_cells = maxCells_;
  limits.digits = digits_;
  const StopQuestion question([&ptc] { return ptc.eval(); });
  answer_ = find_turning_path(scene_, question_, limits, question.monitor());
  cells_ = answer_->looked_at;
  switch (answer_->status) {
    case TurningAnswer::Status::kInvalidStart:
      return ob::PlannerStatus::INVALID_START;
    case TurningAnswer::Status::kInvalidGoal:
      return ob::PlannerStatus::INVALID_GOAL;
    case TurningAnswer::Status::kUndecided:
      return ob::PlannerStatus::TIMEOUT;
    case TurningAnswer::Status::kInfeasible:
      pdef_->setSolutionNonExistenceProof(
          std::make_shared<TurningImpossibility>(si_, scene_, question_, *answer_->proof));
      return infeasible();
    default:
      break;
  }
  auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
  ob::State* state = si_->allocState();
  for (const Pose& pose : answer_->path) {
    space.setPose(state, pose);
    path->append(state);
  }
  if (answer_->path.size() == 1) path->append(state);  // OMPL's checks expect a segment
  si_->freeState(state);
  pdef_->addSolutionPath(path, false, 0.0, name_);
  return ob::PlannerStatus::EXACT_SOLUTION;
}

}  // namespace nef::planner
