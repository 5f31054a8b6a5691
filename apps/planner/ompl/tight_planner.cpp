// SPDX-License-Identifier: Apache-2.0
//
// `solve` makes the free space if need be, takes the start states, and then goals in groups of up to 64; each new goal
// is tried against each start, and the shortest path is the solution. Two goals in one cell are tried once, if the
// first is out of reach. When the region has no more goals and none is in reach, the components of all starts and goals
// are the proof. If the user's own checks reject the exact path, RRTConnect searches for another one.
#include "apps/planner/ompl/tight_planner.h"

#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/ompl/nef_validity.h"
#include "apps/planner/ompl/own_planners.h"
#include "nef/base/interruption.h"
#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"

namespace nef::planner {

namespace ob = ompl::base;
using StateType = ExactTranslationSpace::StateType;

namespace {

// So many goals are tried before the best of them is taken, and so many more while none is in reach.
constexpr unsigned int kGoalsAtOnce = 64;

// True if a thread still looks for goal states.
bool is_growing(const ob::GoalSampleableRegion& region) {
  const auto* lazy = dynamic_cast<const ob::GoalLazySamples*>(&region);
  return lazy != nullptr && lazy->isSampling();
}

}  // namespace

TightPlanner::TightPlanner(const ob::SpaceInformationPtr& si) : TightPlanner(si, nullptr) {}

TightPlanner::TightPlanner(const ob::SpaceInformationPtr& si, FreeSpaceBuilder builder)
    : ob::Planner(si, "TightPlanner"), builder_(std::move(builder)) {
  declare();
}

TightPlanner::~TightPlanner() { freeDataStates(); }

void TightPlanner::freeDataStates() {
  for (ob::State* state : dataStates_) si_->freeState(state);
  dataStates_.clear();
}

void TightPlanner::setMinDimension(unsigned int dimension) {
  if (dimension > 3) {
    throw std::invalid_argument("min_dimension must be 0, 1, 2 or 3, not " + std::to_string(dimension));
  }
  set(options_.min_dimension, static_cast<int>(dimension));
}

void TightPlanner::declare() {
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  specs_.provingSolutionNonExistence = true;
  declareParam<unsigned int>("min_dimension", this, &TightPlanner::setMinDimension, &TightPlanner::getMinDimension,
                             "0:1:3");
  declareParam<bool>("roomy", this, &TightPlanner::setRoomy, &TightPlanner::getRoomy, "0,1");
  declareParam<bool>("clearance", this, &TightPlanner::setClearance, &TightPlanner::getClearance, "0,1");
  declareParam<bool>("thorough", this, &TightPlanner::setThorough, &TightPlanner::getThorough, "0,1");
  declareParam<int>("digits", this, &TightPlanner::setDigits, &TightPlanner::getDigits, "-1:1:300");
  declareParam<bool>("keep_roadmap", this, &TightPlanner::setKeepRoadmap, &TightPlanner::getKeepRoadmap, "0,1");
  addPlannerProgressProperty("preprocessing REAL", [this] { return std::to_string(preprocessing_); });
  addPlannerProgressProperty("free cells INTEGER", [this] { return std::to_string(freeCells_); });
}

void TightPlanner::setup() {
  ob::Planner::setup();
  if (!builder_) updateFreeSpace({});
}

void TightPlanner::updateFreeSpace(const Monitor& monitor) {
  const auto* space = dynamic_cast<const ExactTranslationSpace*>(si_->getStateSpace().get());
  if (space == nullptr) throw ompl::Exception(name_, "the state space must be an ExactTranslationSpace");
  if (builder_ && freeSpace_) return;
  const Stopwatch watch;
  std::shared_ptr<const FreeSpace> present;
  if (builder_) {
    present = builder_(monitor);
  } else if (const auto* checker = dynamic_cast<const NefStateValidityChecker*>(si_->getStateValidityChecker().get())) {
    present = checker->getFreeSpace();
  } else {
    present = space->getFreeSpace();
  }
  if (!present) throw ompl::Exception(name_, "there is no free space: use a NefStateValidityChecker");
  if (present == freeSpace_) return;
  clearQuery();  // its ends are those of another free space
  knownWay_ = std::exchange(lastWay_, {});
  if (!std::exchange(keepWay_, false)) knownWay_.clear();
  std::size_t cells = 0;
  for (const Component& component : present->components()) cells += component.cells;
  freeCells_ = cells;
  freeSpace_ = std::move(present);
  preprocessing_ = watch.seconds();
}

void TightPlanner::clear() {
  ob::Planner::clear();
  clearQuery();
  freeDataStates();
  if (!keepRoadmap_ && builder_) {
    freeSpace_.reset();
    freeCells_ = 0;
    setup_ = false;
  }
}

void TightPlanner::clearQuery() {
  pis_.restart();
  starts_.clear();
  goals_.clear();
  exactPath_.reset();
}

void TightPlanner::setProblemDefinition(const ob::ProblemDefinitionPtr& pdef) {
  ob::Planner::setProblemDefinition(pdef);
  clearQuery();
}

TightPlanner::EndPoint TightPlanner::endPointOf(const ob::State* state) const {
  const auto* exact = static_cast<const StateType*>(state);
  return {exact->exact(), freeSpace_->locate(exact->point())};
}

void TightPlanner::takeStarts() {
  while (const ob::State* state = pis_.nextStart()) starts_.push_back(endPointOf(state));
  std::erase_if(starts_, [this](const EndPoint& end) { return !freeSpace_->is_free(end.cell); });
}

bool TightPlanner::takeGoals(const ob::GoalSampleableRegion& region, const ob::PlannerTerminationCondition& ptc) {
  const bool growing = is_growing(region);
  const auto asked_all = [&] { return pis_.getSampledGoalsCount() >= region.maxSampleCount(); };
  const auto known = static_cast<std::ptrdiff_t>(goals_.size());
  for (unsigned int i = 0; i < kGoalsAtOnce && !asked_all() && (i == 0 || !ptc); ++i) {
    const ob::State* state = pis_.nextGoal();
    if (state == nullptr) continue;  // not valid
    const EndPoint goal = endPointOf(state);
    // Further goals are taken only if none was in reach, so another one in the same cell is out of reach, too.
    const bool is_new = std::none_of(goals_.begin(), goals_.begin() + known,
                                     [&](const EndPoint& end) { return end.cell == goal.cell; });
    if (is_new && freeSpace_->is_free(goal.cell)) goals_.push_back(goal);
  }
  return !growing && asked_all();
}

std::optional<ExactPath> TightPlanner::bestPath(std::size_t firstGoal, const ob::PlannerTerminationCondition& ptc,
                                                bool& interrupted) {
  const StopQuestion question([&ptc] { return ptc.eval(); });
  std::optional<ExactPath> best;
  PathOptions options = options_;
  options.known = knownWay_;
  try {
    for (const EndPoint& start : starts_) {
      for (std::size_t i = firstGoal; i < goals_.size(); ++i) {
        // The first pair is always answered: it takes no longer than noticing the time.
        if ((i > firstGoal || &start != &starts_.front()) && ptc) throw Interrupted();
        auto path = find_path(*freeSpace_, start.position, goals_[i].position, options, question.monitor());
        if (path && (!best || path->length < best->length)) best = std::move(path);
      }
    }
  } catch (const Interrupted&) {
    interrupted = true;
  }
  return best;
}

bool TightPlanner::isAccepted(const ExactPath& path) const {
  return !hasFurtherChecks(*si_) || toPathGeometric(si_, path)->check();
}

ob::PlannerStatus TightPlanner::searchAnotherWay(const ob::PlannerTerminationCondition& ptc) {
  OMPL_WARN("%s: the exact path is rejected by the state validity checker; searching another one by RRTConnect",
            name_.c_str());
  exactPath_.reset();
  ompl::geometric::RRTConnect search(si_);
  search.setProblemDefinition(pdef_);
  search.setup();
  return search.solve(ptc);
}

void TightPlanner::proveInfeasible() {
  const auto components = [this](const std::vector<EndPoint>& places) {
    std::vector<std::uint32_t> result;
    for (const EndPoint& end : places) result.push_back(freeSpace_->component(end.cell));
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  };
  pdef_->setSolutionNonExistenceProof(std::make_shared<DisconnectionProof>(si_, freeSpace_, components(starts_),
                                                                           components(goals_), options_.min_dimension));
}

ob::PlannerStatus TightPlanner::solve(const ob::PlannerTerminationCondition& ptc) {
  if (ptc) return ob::PlannerStatus::TIMEOUT;
  try {
    updateFreeSpace(StopQuestion([&ptc] { return ptc.eval(); }).monitor());
  } catch (const Interrupted&) {
    return ob::PlannerStatus::TIMEOUT;
  }
  checkValidity();
  warn_of_ignored_objective(*pdef_, name_);
  const auto* region = dynamic_cast<const ob::GoalSampleableRegion*>(pdef_->getGoal().get());
  if (region == nullptr) return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  takeStarts();
  if (starts_.empty()) return ob::PlannerStatus::INVALID_START;
  // A proof needs all goals. While there may be more, there is none, and the search goes on.
  for (std::size_t asked = 0;; asked = goals_.size()) {
    const bool all = takeGoals(*region, ptc);
    bool interrupted = false;
    const double roadmap_before = freeSpace_->roadmap_seconds();
    exactPath_ = bestPath(asked, ptc, interrupted);
    preprocessing_ = preprocessing_ + freeSpace_->roadmap_seconds() - roadmap_before;
    if (exactPath_ && !isAccepted(*exactPath_)) return searchAnotherWay(ptc);
    if (exactPath_) {
      lastWay_ = exactPath_->points;
      knownWay_.clear();
      pdef_->addSolutionPath(toPathGeometric(si_, *exactPath_), false, 0.0, name_);
      return ob::PlannerStatus::EXACT_SOLUTION;
    }
    if (all && !interrupted) break;
    if (interrupted || ptc) return ob::PlannerStatus::TIMEOUT;
    if (goals_.size() == asked) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (goals_.empty()) return ob::PlannerStatus::INVALID_GOAL;
  proveInfeasible();
  return infeasible();
}

ob::PlannerDataVertex TightPlanner::dataVertex(const Rational3& position) const {
  ob::State* state = si_->allocState();
  static_cast<StateType*>(state)->setExact(position);
  dataStates_.push_back(state);
  return ob::PlannerDataVertex(state);
}

void TightPlanner::getPlannerData(ob::PlannerData& data) const {
  ob::Planner::getPlannerData(data);
  if (!freeSpace_) return;
  const Roadmap& roadmap = freeSpace_->roadmap();
  std::vector<unsigned int> middles(roadmap.zone_count(), ob::PlannerData::INVALID_INDEX);
  // Roadmap are convex, so what is in the closure of one sees its middle.
  const auto join_to_middle = [&](unsigned int vertex, ZoneId zone) {
    unsigned int& middle = middles[zone];
    if (middle == ob::PlannerData::INVALID_INDEX) middle = data.addVertex(dataVertex(roadmap.interior_point(zone)));
    data.addEdge(vertex, middle);
    data.addEdge(middle, vertex);
  };
  for (PortalId s = 0; s < roadmap.portals().size(); ++s) {
    const unsigned int portal = data.addVertex(dataVertex(roadmap.point(s)));
    for (const ZoneId zone : roadmap.zones_of(s)) join_to_middle(portal, zone);
  }
  const auto join_end = [&](unsigned int vertex, const Rational3& position) {
    const Rational3 near = freeSpace_->tree().nearest_inside(position);
    if (near != position) {
      const unsigned int between = data.addVertex(dataVertex(near));
      data.addEdge(vertex, between);
      data.addEdge(between, vertex);
      vertex = between;
    }
    const ZoneId zone = roadmap.zone_at(ExactPoint(near));
    if (!roadmap.portals_of(zone).empty()) join_to_middle(vertex, zone);
  };
  for (const EndPoint& start : starts_) join_end(data.addStartVertex(dataVertex(start.position)), start.position);
  for (const EndPoint& goal : goals_) join_end(data.addGoalVertex(dataVertex(goal.position)), goal.position);
}

TightPlanner::FreeSpaceBuilder free_space_builder(const Scene& scene) {
  require_no_rotation(scene);
  return [&scene](const Monitor& monitor) { return std::make_shared<const FreeSpace>(free_positions(scene, monitor)); };
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
