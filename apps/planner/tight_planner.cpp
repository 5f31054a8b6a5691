// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/tight_planner.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/config.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <chrono>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/nef_validity.h"

namespace nef::planner {

namespace ob = ompl::base;
using StateType = ExactTranslationSpace::StateType;

namespace {

// Goals of a region that can be sampled for ever; a proof needs all goals, so there is none then.
constexpr unsigned int kGoalsTried = 64;

ob::PlannerStatus infeasible() {
#if defined(OMPL_VERSION_VALUE) && OMPL_VERSION_VALUE >= 1006000
  return ob::PlannerStatus::INFEASIBLE;
#else
  return ob::PlannerStatus::ABORT;
#endif
}

}  // namespace

TightPlanner::TightPlanner(const ob::SpaceInformationPtr& si) : TightPlanner(si, nullptr) {}

TightPlanner::TightPlanner(const ob::SpaceInformationPtr& si, FreeSpaceBuilder builder)
    : ob::Planner(si, "TightPlanner"), builder_(std::move(builder)) {
  options_.thorough = false;
  declare();
}

TightPlanner::~TightPlanner() {
  for (ob::State* state : dataStates_) si_->freeState(state);
}

void TightPlanner::declare() {
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  specs_.provingSolutionNonExistence = true;
  declareParam<unsigned int>("min_dimension", this, &TightPlanner::setMinDimension, &TightPlanner::getMinDimension,
                             "0:1:3");
  declareParam<bool>("roomy", this, &TightPlanner::setRoomy, &TightPlanner::getRoomy, "0,1");
  declareParam<bool>("clearance", this, &TightPlanner::setClearance, &TightPlanner::getClearance, "0,1");
  declareParam<bool>("thorough", this, &TightPlanner::setThorough, &TightPlanner::getThorough, "0,1");
  declareParam<bool>("keep_roadmap", this, &TightPlanner::setKeepRoadmap, &TightPlanner::getKeepRoadmap, "0,1");
  addPlannerProgressProperty("preprocessing REAL", [this] { return std::to_string(preprocessing_); });
  addPlannerProgressProperty("free cells INTEGER", [this] {
    std::size_t cells = 0;
    if (freeSpace_) {
      for (const Component& component : freeSpace_->components()) cells += component.cells;
    }
    return std::to_string(cells);
  });
}

void TightPlanner::setup() {
  ob::Planner::setup();
  if (!freeSpace_) buildFreeSpace([] { return false; });
}

bool TightPlanner::buildFreeSpace(const std::function<bool()>& stop) {
  const auto begin = std::chrono::steady_clock::now();
  const auto* space = dynamic_cast<const ExactTranslationSpace*>(si_->getStateSpace().get());
  if (space == nullptr) throw ompl::Exception(name_, "the state space must be an ExactTranslationSpace");
  if (builder_) {
    freeSpace_ = builder_(stop);
    if (!freeSpace_ && stop()) return false;
  } else if (const auto* checker = dynamic_cast<const NefStateValidityChecker*>(si_->getStateValidityChecker().get())) {
    freeSpace_ = checker->getFreeSpace();
  } else {
    freeSpace_ = space->getFreeSpace();
  }
  if (!freeSpace_) throw ompl::Exception(name_, "there is no free space: use a NefStateValidityChecker");
  preprocessing_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return true;
}

void TightPlanner::clear() {
  ob::Planner::clear();
  clearQuery();
  if (!keepRoadmap_ && builder_) {
    freeSpace_.reset();
    setup_ = false;
  }
}

void TightPlanner::clearQuery() {
  pis_.restart();
  starts_.clear();
  goals_.clear();
  allGoals_ = false;
  exactPath_.reset();
}

TightPlanner::Place TightPlanner::placeOf(const ob::State* state) const {
  const auto* exact = static_cast<const StateType*>(state);
  return {exact->exact(), freeSpace_->locate(exact->point())};
}

bool TightPlanner::takeInput(const ob::PlannerTerminationCondition& ptc, ob::PlannerStatus& failure) {
  const auto* region = dynamic_cast<const ob::GoalSampleableRegion*>(pdef_->getGoal().get());
  if (region == nullptr) {
    failure = ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
    return false;
  }
  while (const ob::State* state = pis_.nextStart()) starts_.push_back(placeOf(state));
  std::erase_if(starts_, [this](const Place& place) { return !freeSpace_->is_free(place.cell); });
  if (starts_.empty()) {
    failure = ob::PlannerStatus::INVALID_START;
    return false;
  }
  const unsigned int count = region->maxSampleCount();
  while (!ptc && goals_.size() < kGoalsTried && pis_.getSampledGoalsCount() < count) {
    const ob::State* state = goals_.empty() ? pis_.nextGoal(ptc) : pis_.nextGoal();
    if (state == nullptr) break;
    goals_.push_back(placeOf(state));
  }
  allGoals_ = pis_.getSampledGoalsCount() >= count;
  std::erase_if(goals_, [this](const Place& place) { return !freeSpace_->is_free(place.cell); });
  if (goals_.empty()) {
    failure = ptc && !allGoals_ ? ob::PlannerStatus::TIMEOUT : ob::PlannerStatus::INVALID_GOAL;
    return false;
  }
  return true;
}

std::optional<ExactPath> TightPlanner::bestPath(const ob::PlannerTerminationCondition& ptc, bool& interrupted) {
  std::optional<ExactPath> best;
  interrupted = false;
  bool first = true;
  for (const Place& start : starts_) {
    for (const Place& goal : goals_) {
      // The first pair is always answered: it takes no longer than noticing the time.
      if (!first && ptc) {
        interrupted = true;
        return best;
      }
      first = false;
      std::optional<ExactPath> path = find_path(*freeSpace_, start.position, goal.position, options_);
      if (path && (!best || path->length < best->length)) best = std::move(path);
    }
  }
  return best;
}

void TightPlanner::addSolution(const ExactPath& path) {
  pdef_->addSolutionPath(toPathGeometric(si_, path), false, 0.0, name_);
}

void TightPlanner::proveInfeasible() {
  const auto components = [this](const std::vector<Place>& places) {
    std::vector<std::uint32_t> result;
    for (const Place& place : places) result.push_back(freeSpace_->component(place.cell));
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  };
  pdef_->setSolutionNonExistenceProof(std::make_shared<DisconnectionProof>(si_, freeSpace_, components(starts_),
                                                                           components(goals_), options_.min_dimension));
}

ob::PlannerStatus TightPlanner::solve(const ob::PlannerTerminationCondition& ptc) {
  if (!freeSpace_ && (ptc || !buildFreeSpace([&ptc] { return ptc.eval(); }))) return ob::PlannerStatus::TIMEOUT;
  checkValidity();
  ob::PlannerStatus failure = ob::PlannerStatus::UNKNOWN;
  if (!takeInput(ptc, failure)) return failure;
  bool interrupted = false;
  exactPath_ = bestPath(ptc, interrupted);
  if (exactPath_) {
    addSolution(*exactPath_);
    return ob::PlannerStatus::EXACT_SOLUTION;
  }
  if (interrupted || !allGoals_) return ob::PlannerStatus::TIMEOUT;
  proveInfeasible();
  return infeasible();
}

void TightPlanner::getPlannerData(ob::PlannerData& data) const {
  ob::Planner::getPlannerData(data);
  if (!freeSpace_) return;
  const auto make_state = [this](const Rational3& position) {
    ob::State* state = si_->allocState();
    static_cast<StateType*>(state)->setExact(position);
    dataStates_.push_back(state);
    return state;
  };
  const Zones& zones = freeSpace_->zones();
  std::vector<unsigned int> middle(zones.zone_count(), ob::PlannerData::INVALID_INDEX);
  for (StationId s = 0; s < zones.stations().size(); ++s) {
    const unsigned int station = data.addVertex(ob::PlannerDataVertex(make_state(zones.point(s))));
    for (const ZoneId zone : zones.zones_of(s)) {
      if (middle[zone] == ob::PlannerData::INVALID_INDEX) {
        middle[zone] = data.addVertex(ob::PlannerDataVertex(make_state(zones.interior_point(zone))));
      }
      data.addEdge(station, middle[zone]);
      data.addEdge(middle[zone], station);
    }
  }
}

TightPlanner::FreeSpaceBuilder free_space_builder(const Scene& scene) {
  return [&scene](const std::function<bool()>& stop) -> std::shared_ptr<const FreeSpace> {
    BuildOptions options;
    options.stop = stop;
    try {
      return std::make_shared<const FreeSpace>(free_positions(scene, options));
    } catch (const minkowski::Cancelled&) {
      return nullptr;
    }
  };
}

std::shared_ptr<ompl::geometric::PathGeometric> toPathGeometric(const ob::SpaceInformationPtr& si,
                                                                const ExactPath& path) {
  auto result = std::make_shared<ompl::geometric::PathGeometric>(si);
  ob::State* state = si->allocState();
  const auto append = [&](const Rational3& point) {
    static_cast<StateType*>(state)->setExact(point);
    result->append(state);
  };
  for (const Rational3& point : path.points) append(point);
  // OMPL's own checks expect a segment, even from a state to itself.
  if (path.points.size() == 1) append(path.points.front());
  si->freeState(state);
  return result;
}

}  // namespace nef::planner
