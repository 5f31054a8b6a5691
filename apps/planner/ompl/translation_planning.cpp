// SPDX-License-Identifier: Apache-2.0
//
// Setters change the scene and discard the free space; up to eight changes of obstacles since it was made are
// remembered, and each is applied to it by one Boolean operation. Before solving, `prepare` compares bounds, state
// checker and motion validator with what it installed last: whatever differs comes from the user and is adopted (bounds
// become the scene's box, checkers are asked as well).
#include "apps/planner/ompl/translation_planning.h"

#include <ompl/base/goals/GoalState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <typeinfo>

#include "apps/planner/free_space/free_positions.h"
#include "apps/planner/ompl/cell_sampler.h"
#include "apps/planner/ompl/nef_validity.h"
#include "apps/planner/scene/shapes.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/base/timing/time_limit.h"

namespace nef::planner {

namespace ob = ompl::base;

TranslationPlanning::TranslationPlanning() : ompl::geometric::SimpleSetup(std::make_shared<ExactTranslationSpace>()) {
  scene_.name = "TranslationPlanning";
  setPlannerAllocator([](const ob::SpaceInformationPtr& si) { return std::make_shared<TightPlanner>(si); });
  // The space needs bounds before anybody makes a state; real ones follow in setup(). Whatever else is found there by
  // then is the user's.
  ob::RealVectorBounds bounds(3);
  bounds.setLow(std::nextafter(-1.0, -2.0));
  bounds.setHigh(std::nextafter(1.0, 2.0));
  setStateBounds(bounds);
}

TranslationPlanning::TranslationPlanning(const Problem& problem) : TranslationPlanning() {
  scene_ = problem.scene();
  useFreeSpace(problem.shared_free_space());
  if (scene_.start && scene_.goal) setExactStartAndGoal(*scene_.start, *scene_.goal);
  inferEnvironmentBounds();
}

ExactTranslationSpace& TranslationPlanning::space() const {
  return *static_cast<ExactTranslationSpace*>(si_->getStateSpace().get());
}

bool TranslationPlanning::setMeshPath(const std::vector<std::string>& folders) {
  folders_ = folders;
  return std::all_of(folders.begin(), folders.end(), [](const std::string& folder) {
    if (std::error_code unknown; std::filesystem::is_directory(folder, unknown)) return true;
    OMPL_WARN("%s is not a folder", folder.c_str());
    return false;
  });
}

std::string TranslationPlanning::find(const std::string& file) const {
  std::error_code unknown;
  if (std::filesystem::exists(file, unknown)) return file;
  for (const std::string& folder : folders_) {
    const std::filesystem::path path = std::filesystem::path(folder) / file;
    if (std::filesystem::exists(path, unknown)) return path.string();
  }
  return file;
}

bool TranslationPlanning::readMesh(const std::string& file, Polyhedron& into, bool add) {
  try {
    const Polyhedron shape = closure(read_shape_file(find(file), scene_meshes(), &scene_.messages));
    into = add ? unite(into, shape) : shape;
    changed();
    return true;
  } catch (const Error& error) {
    OMPL_ERROR("%s", error.what());
    return false;
  }
}

bool TranslationPlanning::setRobotMesh(const std::string& file) { return readMesh(file, scene_.robot, false); }

bool TranslationPlanning::addRobotMesh(const std::string& file) { return readMesh(file, scene_.robot, true); }

bool TranslationPlanning::setEnvironmentMesh(const std::string& file) {
  scene_.obstacles.clear();
  scene_.obstacle_names.clear();
  return addEnvironmentMesh(file);
}

bool TranslationPlanning::addEnvironmentMesh(const std::string& file) {
  Polyhedron shape;
  if (!readMesh(file, shape, false)) return false;
  scene_.obstacles.push_back(shape);
  scene_.obstacle_names.push_back(file);
  return true;
}

void TranslationPlanning::setRobot(const Polyhedron& robot) {
  scene_.robot = closure(robot);
  changed();
}

void TranslationPlanning::addObstacle(const Polyhedron& obstacle) {
  obstacleChanged({std::nullopt, closure(obstacle)});
}

void TranslationPlanning::requireObstacle(std::size_t index) const {
  if (index >= scene_.obstacles.size()) throw std::out_of_range("there is no obstacle " + std::to_string(index));
}

void TranslationPlanning::removeObstacle(std::size_t index) {
  requireObstacle(index);
  obstacleChanged({index, std::nullopt});
}

void TranslationPlanning::moveObstacle(std::size_t index, const Rational3& by) {
  moveObstacle(index, AffineMap::translate(by));
}

void TranslationPlanning::moveObstacle(std::size_t index, const AffineMap& map) {
  requireObstacle(index);
  obstacleChanged({index, transform(scene_.obstacles[index], map)});
}

void TranslationPlanning::obstacleChanged(ObstacleChange change) {
  apply(change, scene_);
  std::optional<Before> before = std::move(before_);
  std::vector<ObstacleChange> changes = std::move(changes_);
  changed();
  if (!before) return;
  changes.push_back(std::move(change));
  before_ = std::move(before);
  changes_ = std::move(changes);
  const bool only_came =
      std::none_of(changes_.begin(), changes_.end(), [](const ObstacleChange& c) { return c.index; });
  if (TightPlanner* planner = getTightPlanner(); planner != nullptr) planner->keepWay(only_came);
}

Polyhedron TranslationPlanning::presentFreePositions(const Monitor& monitor) const {
  // From here on, uniting all sums at once is faster than one operation with all of free space for each.
  constexpr std::size_t kFewChanges = 8;
  if (!before_ || changes_.size() > kFewChanges || !obstacles_are_independent(scene_)) {
    return free_positions(scene_, monitor);
  }
  Scene scene = before_->scene;
  Polyhedron free = before_->free;
  for (const ObstacleChange& change : changes_) {
    free = free_positions_after(change, scene, free, monitor);
    apply(change, scene);
  }
  return free;
}

void TranslationPlanning::setContact(ContactRule contact) {
  scene_.contact = contact;
  changed();
}

void TranslationPlanning::setBox(const Rational3& low, const Rational3& high) {
  scene_.box = {low, high};
  changed();
}

void TranslationPlanning::setEnvironmentBounds(const Rational3& low, const Rational3& high) {
  setBox(low, high);
  inferEnvironmentBounds();  // what was set on the state space before counts no more
}

void TranslationPlanning::changed() {
  before_.reset();
  changes_.clear();
  freeSpace_.reset();
  configured_ = false;
  if (TightPlanner* planner = getTightPlanner(); planner != nullptr) planner->keepWay(false);
  if (planner_) planner_->clear();
}

void TranslationPlanning::setExactStartAndGoal(const Rational3& start, const Rational3& goal) {
  scene_.start = start;
  scene_.goal = goal;
  ob::ScopedState<> from(si_);
  ob::ScopedState<> to(si_);
  static_cast<ExactTranslationSpace::StateType*>(from.get())->setExact(start);
  static_cast<ExactTranslationSpace::StateType*>(to.get())->setExact(goal);
  setStartAndGoalStates(from, to);
  if (freeSpace_ && !hasBoundsOfUser()) inferEnvironmentBounds();
}

std::vector<const ob::State*> TranslationPlanning::endStates() const {
  std::vector<const ob::State*> result;
  for (unsigned int s = 0; s < pdef_->getStartStateCount(); ++s) result.push_back(pdef_->getStartState(s));
  const ob::Goal* goal = pdef_->getGoal().get();
  if (const auto* one = dynamic_cast<const ob::GoalState*>(goal)) result.push_back(one->getState());
  if (const auto* several = dynamic_cast<const ob::GoalStates*>(goal)) {
    for (unsigned int g = 0; g < several->getStateCount(); ++g) result.push_back(several->getState(g));
  }
  return result;
}

void TranslationPlanning::inferEnvironmentBounds() {
  ob::RealVectorBounds bounds(3);
  const std::array<Rational3, 2> corners =
      freeSpace_ ? freeSpace_->bounds() : std::array<Rational3, 2>{Rational3{0, 0, 0}, Rational3{0, 0, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    double low = nearest_double(corners[0][i]) - 1;
    double high = nearest_double(corners[1][i]) + 1;
    for (const ob::State* state : endStates()) {
      const double x = state->as<ExactTranslationSpace::StateType>()->values[i];
      low = std::min(low, x - 1);
      high = std::max(high, x + 1);
    }
    if (scene_.box) {
      // The box itself bounds free space; the state space is a hair larger, since it must not be flat.
      low = nearest_double((*scene_.box)[0][i]);
      high = nearest_double((*scene_.box)[1][i]);
      const double slack = 1e-9 * std::max({1.0, std::fabs(low), std::fabs(high)});
      low -= slack;
      high += slack;
    }
    bounds.setLow(static_cast<unsigned int>(i), low);
    bounds.setHigh(static_cast<unsigned int>(i), high);
  }
  setStateBounds(bounds);
}

void TranslationPlanning::setStateBounds(const ob::RealVectorBounds& bounds) {
  space().setBounds(bounds);
  bounds_ = bounds;
  boundsOfUser_ = false;
}

bool TranslationPlanning::boundsAreKnown() const {
  const ob::RealVectorBounds& present = space().getBounds();
  return bounds_ && bounds_->low == present.low && bounds_->high == present.high;
}

void TranslationPlanning::adoptBounds() {
  const ob::RealVectorBounds present = space().getBounds();
  if (boundsAreKnown()) return;
  Rational3 low;
  Rational3 high;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(present.low[i]) || !std::isfinite(present.high[i]) || present.low[i] > present.high[i]) {
      throw ompl::Exception("TranslationPlanning", "the bounds of the state space must be finite, low before high");
    }
    low[i] = exact_rational(present.low[i]);
    high[i] = exact_rational(present.high[i]);
  }
  setBox(low, high);
  bounds_ = present;
  boundsOfUser_ = true;
}

bool TranslationPlanning::noteCheckers() {
  const ob::StateValidityCheckerPtr& checker = si_->getStateValidityChecker();
  const ob::MotionValidatorPtr& validator = si_->getMotionValidator();
  // Exact ones on the present free space are as good as ours, and on another one they have had their time.
  const auto* exact_checker = dynamic_cast<const NefStateValidityChecker*>(checker.get());
  const auto* exact_validator = dynamic_cast<const NefMotionValidator*>(validator.get());
  bool changed = false;
  if (exact_checker == nullptr || exact_checker->getFreeSpace() != freeSpace_) {
    changed = true;
    // OMPL's stand-in for a missing checker has nothing to say.
    const bool is_default = dynamic_cast<const ob::AllValidStateValidityChecker*>(checker.get()) != nullptr;
    if (exact_checker == nullptr) userChecker_ = is_default ? nullptr : checker;
  }
  if (exact_validator == nullptr || exact_validator->getFreeSpace() != freeSpace_) {
    changed = true;
    // The default only asks for states; our validator does that itself where there is something to ask.
    const ob::MotionValidator* present = validator.get();
    const bool is_default = present != nullptr && typeid(*present) == typeid(ob::DiscreteMotionValidator);
    if (exact_validator == nullptr) userValidator_ = is_default ? nullptr : validator;
  }
  return changed;
}

void TranslationPlanning::installCheckers() {
  setStateValidityChecker(std::make_shared<NefStateValidityChecker>(si_, freeSpace_, userChecker_));
  si_->setMotionValidator(std::make_shared<NefMotionValidator>(si_, freeSpace_, userValidator_));
  configured_ = false;
}

void TranslationPlanning::useFreeSpace(std::shared_ptr<const FreeSpace> freeSpace) {
  freeSpace_ = std::move(freeSpace);
  before_ = Before{scene_, freeSpace_->set()};
  changes_.clear();
  space().setFreeSpace(freeSpace_);
  noteCheckers();
  installCheckers();
  si_->setValidStateSamplerAllocator([free = freeSpace_](const ob::SpaceInformation* si) {
    return std::make_shared<CellValidStateSampler>(si, free);
  });
}

void TranslationPlanning::prepare(const Monitor& monitor) {
  adoptBounds();
  if (!freeSpace_) {
    if (scene_.robot.is_empty()) throw ompl::Exception("TranslationPlanning", "no robot is set");
    useFreeSpace(std::make_shared<const FreeSpace>(presentFreePositions(monitor)));
    if (!boundsOfUser_) inferEnvironmentBounds();
  }
  if (noteCheckers()) installCheckers();
  // New start and goal states may lie far out in free space.
  const std::vector<const ob::State*> ends = endStates();
  const auto inside = [this](const ob::State* state) { return space().satisfiesBounds(state); };
  if (!boundsOfUser_ && !std::all_of(ends.begin(), ends.end(), inside)) inferEnvironmentBounds();
  // TightPlanner makes the roadmap when it needs it; other planners ask for thousands of states.
  if (planner_ && getTightPlanner() == nullptr) freeSpace_->build_roadmap(monitor);
}

template <typename Solve>
ob::PlannerStatus TranslationPlanning::prepareAndSolve(const Monitor& monitor, const Solve& solve) {
  const Stopwatch watch;
  try {
    prepare(monitor);
  } catch (const Interrupted&) {
    planTime_ = watch.seconds();
    OMPL_INFORM("No free space after %f seconds", planTime_);
    return lastStatus_ = ob::PlannerStatus::TIMEOUT;
  }
  return solve();
}

void TranslationPlanning::setup() {
  prepare({});
  ompl::geometric::SimpleSetup::setup();
}

ob::PlannerStatus TranslationPlanning::solve(double time) {
  const TimeLimit limit(time);
  return prepareAndSolve(limit.monitor(),
                         [&] { return ompl::geometric::SimpleSetup::solve(std::max(0.0, time - limit.passed())); });
}

ob::PlannerStatus TranslationPlanning::solve(const ob::PlannerTerminationCondition& ptc) {
  const StopQuestion question([&ptc] { return ptc.eval(); });
  return prepareAndSolve(question.monitor(), [&] { return ompl::geometric::SimpleSetup::solve(ptc); });
}

}  // namespace nef::planner
