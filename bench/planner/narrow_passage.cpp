// SPDX-License-Identifier: Apache-2.0
//
// The narrow-passage table: two unit rooms, a wall 0.2 thick, a cube of side 1/4, and an opening of the
// cube's size plus w, in y and z ("hole") or in y alone ("slot"). Our planner, everything included, beside
// OMPL's with uniform samplers on the same exact checks, so that nothing is blamed on checking.
//
//   bench_planner_narrow_passage [seconds per run, 10] [runs, 3]
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/samplers/BridgeTestValidStateSampler.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "apps/planner/command/report.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/ompl/translation_planning.h"
#include "bench/planner/timed_checks.h"

namespace nef::planner {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

Rational r(const char* text) { return parse_rational(text); }

// The opening is w wider than the cube; negative w: too narrow.
Scene scene_of(bool hole, const Rational& w) {
  Scene scene;
  scene.name = hole ? "hole" : "slot";
  scene.robot = make_box({r("-1/8"), r("-1/8"), r("-1/8")}, {r("1/8"), r("1/8"), r("1/8")});
  const Polyhedron outer = make_box({-1, -1, -1}, {r("3.2"), 2, 2});
  scene.obstacles.push_back(closure(subtract(outer, make_box({0, 0, 0}, {r("2.2"), 1, 1}))));
  const Rational half_y = (r("1/4") + w) / 2;
  const Rational half_z = hole ? half_y : r("1/4");
  const Rational middle = r("1/2");
  const Polyhedron opening =
      make_box({r("0.9"), middle - half_y, middle - half_z}, {r("1.3"), middle + half_y, middle + half_z});
  scene.obstacles.push_back(closure(subtract(make_box({1, 0, 0}, {r("1.2"), 1, 1}), opening)));
  scene.obstacle_names = {"rooms", "wall"};
  scene.start = Rational3{r("0.3"), r("0.25"), r("0.3")};
  scene.goal = Rational3{r("1.9"), r("0.75"), r("0.7")};
  return scene;
}

// Where the cube's centre can be at all: nothing else is sampled, so that every invalid state is in the wall, as the
// bridge test likes it.
ob::RealVectorBounds reach() {
  ob::RealVectorBounds bounds(3);
  bounds.setLow(0.125);
  bounds.setHigh(0.875);
  bounds.setHigh(0, 2.075);
  return bounds;
}

void run_ours(bool hole, const char* width, unsigned runs) {
  std::vector<double> all;
  std::vector<double> again;
  std::string answer;
  for (unsigned i = 0; i < runs; ++i) {
    ProcessStopwatch watch;
    const Problem problem(scene_of(hole, r(width)));
    PathOptions options;
    options.thorough = false;
    answer = status_name(problem.solve(options).status);
    all.push_back(watch.lap());
    static_cast<void>(problem.solve({r("0.31"), r("0.3"), r("0.3")}, {r("1.8"), r("0.7"), r("0.7")}, options));
    again.push_back(watch.lap());
  }
  std::printf("| %s | %s | TightPlanner | %s, %u/%u | %.4f | %.5f (next query) | |\n", hole ? "hole" : "slot", width,
              answer.c_str(), runs, runs, median(all), median(again));
  std::fflush(stdout);
}

void run_stock(bool hole, const char* width, const char* name, double seconds, unsigned runs) {
  const Problem problem(scene_of(hole, r(width)));
  const bool bridge = std::string(name) == "PRM bridge";
  unsigned solved = 0;
  std::vector<double> times;
  double wall = 0;
  CheckTime checks;
  for (unsigned i = 0; i < runs; ++i) {
    auto space = std::make_shared<ExactTranslationSpace>();  // no free space: uniform samplers
    space->setBounds(reach());
    og::SimpleSetup setup(space);
    const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
    setup.setStateValidityChecker(std::make_shared<TimedState>(si, problem.shared_free_space(), checks));
    si->setMotionValidator(std::make_shared<TimedMotion>(si, problem.shared_free_space(), checks));
    if (bridge) {
      si->setValidStateSamplerAllocator(
          [](const ob::SpaceInformation* s) { return std::make_shared<ob::BridgeTestValidStateSampler>(s); });
    }
    ob::ScopedState<> start(space);
    ob::ScopedState<> goal(space);
    static_cast<ExactTranslationSpace::StateType*>(start.get())->setExact(*problem.scene().start);
    static_cast<ExactTranslationSpace::StateType*>(goal.get())->setExact(*problem.scene().goal);
    setup.setStartAndGoalStates(start, goal);
    // Optimizing planners would use all the time: any solution is good enough, so the first one counts.
    auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(si);
    objective->setCostThreshold(objective->infiniteCost());
    setup.setOptimizationObjective(objective);
    setup.setPlanner(make_ompl_planner(bridge ? "PRM" : name, si));
    setup.setup();
    const Stopwatch watch;
    setup.solve(seconds);
    const double passed = watch.seconds();
    wall += passed;
    if (!setup.haveExactSolutionPath()) continue;
    ++solved;
    times.push_back(passed);
  }
  char time[32] = "-";
  if (solved > 0) std::snprintf(time, sizeof time, "%.4f", median(times));
  std::printf("| %s | %s | %s | %u/%u | %s | | %.0f %% in checks |\n", hole ? "hole" : "slot", width, name, solved,
              runs, time, 100 * checks.seconds / wall);
  std::fflush(stdout);
}

void time_checks() {
  const Problem problem(scene_of(true, r("0")));
  auto space = std::make_shared<ExactTranslationSpace>();
  space->setBounds(reach());
  auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker(std::make_shared<NefStateValidityChecker>(si, problem.shared_free_space()));
  si->setMotionValidator(std::make_shared<NefMotionValidator>(si, problem.shared_free_space()));
  si->setup();
  const ob::StateSamplerPtr sampler = si->allocStateSampler();
  constexpr std::size_t kStates = 1000;
  std::vector<ob::State*> states(kStates);
  si->allocStates(states);
  for (ob::State* state : states) sampler->sampleUniform(state);
  constexpr int kRounds = 100;
  unsigned valid = 0;
  Stopwatch watch;
  for (int round = 0; round < kRounds; ++round) {
    for (const ob::State* state : states) valid += si->isValid(state) ? 1 : 0;
  }
  const double state_check = watch.lap() / (kRounds * kStates);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i + 1 < kStates; ++i) valid += si->checkMotion(states[i], states[i + 1]) ? 1 : 0;
  }
  const double motion_check = watch.lap() / (kRounds * kStates);
  std::printf("\nstate check %.3f us, motion check %.3f us (%u valid)\n", 1e6 * state_check, 1e6 * motion_check, valid);
  si->freeStates(states);
}

int run(int argc, char** argv) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10;
  const unsigned runs = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 3;
  std::printf("| opening | w | planner | solved | median s | | |\n|---|---|---|---|---|---|---|\n");
  for (const bool hole : {true, false}) {
    for (const char* width : {"1e-1", "1e-2", "1e-3", "1e-4", "0", "-1e-4"}) {
      run_ours(hole, width, std::max(runs, 3U));
      for (const char* name : {"RRTConnect", "PRM bridge", "PRMstar", "BITstar"}) {
        if (seconds > 0) run_stock(hole, width, name, seconds, runs);
      }
    }
  }
  time_checks();
  return 0;
}

}  // namespace
}  // namespace nef::planner

int main(int argc, char** argv) { return nef::planner::run(argc, argv); }
