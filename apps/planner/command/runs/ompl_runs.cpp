// SPDX-License-Identifier: Apache-2.0
//
// TranslationPlanning, TurningPlanning and SE3Planning give the planner exact validity checks. Whatever OMPL returns is
// checked once more here, exactly (`describe_path`, the path's own check for robots that turn about an axis, `certify`
// for those that turn freely), and only counts if that succeeds.
// Of several runs the shortest path is reported. A benchmark adds TightPlanner, which has to build its free space in
// each run, and columns for T, J and proofs.
#include "apps/planner/command/runs/ompl_runs.h"

#include <ompl/base/goals/GoalState.h>
#include <ompl/tools/benchmark/Benchmark.h>
#include <ompl/util/Console.h>

#include <atomic>
#include <sstream>

#include "apps/planner/command/report.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/ompl/translation_planning.h"
#include "apps/planner/path/simple_points.h"
#include "apps/planner/rigid_ompl/se3_planning.h"
#include "apps/planner/turning_ompl/turning_planning.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/base/timing/time_limit.h"
#include "nef/io/file_bytes.h"

namespace nef::planner {
namespace {

namespace ob = ompl::base;

std::vector<Rational3> exact_points(ompl::geometric::PathGeometric& path) {
  std::vector<Rational3> points;
  for (const ob::State* state : path.getStates()) {
    Rational3 point = state->as<ExactTranslationSpace::StateType>()->exact();
    if (points.empty() || points.back() != point) points.push_back(std::move(point));
  }
  return points;
}

// OMPL writes to the console as it likes; here only what goes wrong.
class QuietOmpl {
 public:
  QuietOmpl() : level_(ompl::msg::getLogLevel()) { ompl::msg::setLogLevel(ompl::msg::LOG_ERROR); }
  ~QuietOmpl() { ompl::msg::setLogLevel(level_); }
  QuietOmpl(const QuietOmpl&) = delete;
  QuietOmpl& operator=(const QuietOmpl&) = delete;

 private:
  ompl::msg::LogLevel level_;
};

// Lets a planner run until it has a solution, its time is over, or somebody stops it; then Interrupted is thrown.
template <typename Setup>
ob::PlannerStatus solve_watched(Setup& setup, double seconds, const Monitor& monitor) {
  std::atomic<bool> stopped = false;  // planners with several threads ask in each
  const ob::PlannerTerminationCondition is_stopped([watched = monitor.of_other_thread(), &stopped] {
    try {
      watched.check_interruption();
    } catch (const Interrupted&) {
      stopped = true;
    }
    return stopped.load();
  });
  const ob::PlannerStatus status =
      setup.solve(ob::plannerOrTerminationCondition(ob::timedPlannerTerminationCondition(seconds), is_stopped));
  monitor.check_interruption();
  return status;
}

ob::PlannerPtr planner_for_turning(const std::string& name, const ob::SpaceInformationPtr& si) {
  ob::PlannerPtr planner = make_ompl_planner(name, si);
  if (dynamic_cast<const TightPlanner*>(planner.get()) != nullptr) {
    throw InputError("TightPlanner only translates; without --ompl the planner for robots that turn is used");
  }
  return planner;
}

// What a planner would only report as not found.
void require_free_doubles(SE3Planning& setup, const std::string& scene) {
  const ob::ProblemDefinition& problem = *setup.getProblemDefinition();
  const auto require = [&](const char* name, const ob::State* state) {
    if (setup.getSpaceInformation()->isValid(state)) return;
    throw InputError(scene + ": the " + name +
                     " is free, but not once it is rounded to the doubles of OMPL's states; " +
                     "move it away from what it touches, or leave out --ompl");
  };
  require("start", problem.getStartState(0));
  require("goal", problem.getGoal()->as<ob::GoalState>()->getState());
}

// The path with rounded way-points.
ExactPath rounded_path(const FreeSpace& free, ExactPath path, unsigned digits) {
  const CellFilter filter(free);
  const std::vector<std::size_t> unrounded = round_points(
      [&](const Rational3& a, const Rational3& b) { return segment_allowed(free, filter, a, b); }, path.points, digits);
  path = *describe_path(free, std::move(path.points));
  path.unrounded = unrounded;
  return path;
}

void take_path(const Problem& problem, TranslationPlanning& setup, const OmplRequest& request, OmplOutcome& outcome) {
  if (!setup.haveExactSolutionPath()) return;
  const FreeSpace& free = problem.free_space();
  std::optional<ExactPath> path = describe_path(free, exact_points(setup.getSolutionPath()));
  if (!path) return;  // not a path after all
  if (request.digits) path = rounded_path(free, std::move(*path), *request.digits);
  ++outcome.solved;
  if (!outcome.answer.path || path->length < outcome.answer.path->length) outcome.answer.path = std::move(path);
}

}  // namespace

OmplOutcome run_ompl(const Problem& problem, const OmplRequest& request, const Monitor& monitor) {
  const QuietOmpl quiet;
  OmplOutcome outcome;
  outcome.answer = problem.solve({}, monitor);  // says whether start and goal are free, and the best T and J
  outcome.answer.path.reset();
  TranslationPlanning setup(problem);
  setup.setPlanner(make_ompl_planner(request.planner, setup.getSpaceInformation()));
  const bool invalid =
      outcome.answer.status == Answer::Status::kInvalidStart || outcome.answer.status == Answer::Status::kInvalidGoal;
  double seconds = 0;
  bool proved = false;
  for (unsigned run = 0; run < request.runs && !invalid; ++run) {
    if (run > 0) setup.clear();  // not before the first: AITstar cannot be cleared before it is set up
    const Stopwatch watch;
    solve_watched(setup, request.seconds, monitor);
    seconds += watch.seconds();
    proved = proved || setup.getProblemDefinition()->hasSolutionNonExistenceProof();
    take_path(problem, setup, request, outcome);
  }
  outcome.answer.phases["ompl"] = seconds;
  std::ostringstream line;
  line << setup.getPlanner()->getName() << ": solved " << outcome.solved << " of " << request.runs << " runs, mean "
       << seconds / request.runs << " s";
  if (proved) {
    line << ", proved that there is no path";
  } else if (outcome.solved == 0 && !invalid) {
    line << "; this proves nothing (without --ompl: a path, or a proof that there is none)";
  }
  outcome.summary = line.str();
  if (invalid) {
    outcome.exit_code = 3;
    outcome.summary =
        std::string(status_name(outcome.answer.status)) + ": " + describe(*outcome.answer.collision, problem.scene());
  } else if (outcome.solved > 0) {
    outcome.answer.status = Answer::Status::kPath;
    outcome.exit_code = 0;
  } else {
    outcome.answer.status = proved ? Answer::Status::kInfeasible : Answer::Status::kUndecided;
    outcome.exit_code = proved ? 1 : 4;
  }
  return outcome;
}

TurningAnswer run_turning_ompl(const Scene& scene, const std::string& planner, double seconds, const Monitor& monitor) {
  const QuietOmpl quiet;
  TurningAnswer answer;
  TurningPlanning setup(scene);
  setup.setPlanner(planner_for_turning(planner, setup.getSpaceInformation()));
  switch (static_cast<ob::PlannerStatus::StatusType>(solve_watched(setup, seconds, monitor))) {
    case ob::PlannerStatus::INVALID_START:
      answer.status = TurningAnswer::Status::kInvalidStart;
      return answer;
    case ob::PlannerStatus::INVALID_GOAL:
      answer.status = TurningAnswer::Status::kInvalidGoal;
      return answer;
    default:
      break;
  }
  answer.open_ranges.push_back({setup.getQuestion().low, setup.getQuestion().high});
  if (!setup.haveExactSolutionPath() || !setup.getSolutionPath().check()) return answer;
  answer.status = TurningAnswer::Status::kPath;
  answer.open_ranges.clear();
  for (const ob::State* state : setup.getSolutionPath().getStates()) {
    Pose pose = setup.space().pose(state);
    // Angles go on by the shorter way round.
    if (!answer.path.empty()) {
      while (pose.turn - answer.path.back().turn > 2) pose.turn -= 4;
      while (answer.path.back().turn - pose.turn > 2) pose.turn += 4;
    }
    answer.path.push_back(std::move(pose));
  }
  return answer;
}

RigidAnswer run_rigid_ompl(const Scene& scene, const std::shared_ptr<const MotionChecker>& checker,
                           const std::string& planner, double seconds, const Monitor& monitor) {
  if (auto invalid = invalid_rigid_end(scene, *checker, monitor)) return *std::move(invalid);
  const QuietOmpl quiet;
  const TimeLimit limit(seconds, monitor);
  SE3Planning setup(scene, checker);
  setup.space().getSlices()->setMonitor(limit.monitor());
  setup.setPlanner(planner_for_turning(planner, setup.getSpaceInformation()));
  require_free_doubles(setup, scene.name);
  solve_watched(setup, seconds, monitor);
  RigidAnswer answer;
  if (!setup.haveExactSolutionPath()) return answer;
  std::vector<RigidPose> path = setup.getSolutionPoses();
  CertifiedPath certified = certify(*checker, path, MotionTiming::kSlerp, {}, monitor);
  if (certified.status != MotionVerdict::Status::kFree) return answer;
  answer.status = RigidAnswer::Status::kPath;
  answer.path = std::move(path);
  answer.certified = std::move(certified);
  return answer;
}

int run_benchmark(const Problem& problem, const Arguments& a) {
  const QuietOmpl quiet_ompl;
  const Answer ends = problem.solve();
  if (ends.collision) {
    std::printf("%s: %s\n", status_name(ends.status), describe(*ends.collision, problem.scene()).c_str());
    return 3;
  }
  TranslationPlanning setup(problem);
  setup.setup();
  problem.free_space().build_roadmap();  // not in the time of whoever asks first
  ompl::tools::Benchmark benchmark(setup, problem.scene().name);
  const auto tight = std::make_shared<TightPlanner>(setup.getSpaceInformation(), free_space_builder(problem.scene()));
  tight->setKeepRoadmap(false);
  benchmark.addPlanner(tight);
  for (const std::string& name : a.planners) {
    benchmark.addPlanner(make_ompl_planner(name, setup.getSpaceInformation()));
  }
  benchmark.setPostRunEvent([&](const ob::PlannerPtr& planner, ompl::tools::Benchmark::RunProperties& properties) {
    const auto* ours = dynamic_cast<const TightPlanner*>(planner.get());
    const bool path = ours != nullptr && ours->getExactPath().has_value();
    properties["thinnest piece INTEGER"] = path ? std::to_string(ours->getExactPath()->thinness.piece) : "-1";
    properties["thinnest junction INTEGER"] = path ? std::to_string(ours->getExactPath()->thinness.junction) : "-1";
    properties["proved infeasible BOOLEAN"] =
        planner->getProblemDefinition()->hasSolutionNonExistenceProof() ? "1" : "0";
    properties["preprocessing REAL"] = std::to_string(ours != nullptr ? ours->getPreprocessingTime() : 0.0);
  });
  ompl::tools::Benchmark::Request request;
  request.maxTime = a.time.value_or(kOmplSeconds);
  request.runCount = a.runs;
  request.displayProgress = false;
  request.saveConsoleOutput = false;
  benchmark.benchmark(request);
  std::ostringstream text;
  benchmark.saveResultsToStream(text);
  write_file(a.benchmark, text.str());
  if (!a.session.quiet) {
    std::printf("benchmark of %zu planners, %u runs each: %s\n", a.planners.size() + 1, a.runs, a.benchmark.c_str());
  }
  return 0;
}

}  // namespace nef::planner
