// SPDX-License-Identifier: Apache-2.0
//
// What OMPL asks of planners, spaces and samplers beside solving: termination, statuses, parameters, storage, samplers
// for informed planners, benchmarks.
#include <ompl/base/goals/GoalRegion.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/samplers/InformedStateSampler.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>
#ifdef PLANNER_TEST_STORAGE
#include <ompl/base/PlannerDataStorage.h>
#endif

#include <atomic>
#include <catch2/catch.hpp>
#include <sstream>
#include <thread>

#include "apps/planner/command/runs/ompl_runs.h"
#include "apps/planner/ompl/cell_sampler.h"
#include "apps/planner/ompl/nef_validity.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/ompl/translation_planning.h"
#include "tests/planner/command_helpers.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;
using StateType = ExactTranslationSpace::StateType;

// A space with the exact checks of a problem, and a problem definition.
struct World {
  explicit World(const std::string& name) : problem(load(name)), setup(problem), si(setup.getSpaceInformation()) {
    setup.setup();
    definition = std::make_shared<ob::ProblemDefinition>(si);
    definition->addStartState(setup.getProblemDefinition()->getStartState(0));
    definition->setGoal(setup.getGoal());
  }
  Problem problem;
  TranslationPlanning setup;
  ob::SpaceInformationPtr si;
  ob::ProblemDefinitionPtr definition;
};

// A region that cannot be sampled.
struct Somewhere : ob::GoalRegion {
  using ob::GoalRegion::GoalRegion;
  double distanceGoal(const ob::State* /*state*/) const override { return 0; }
};

TEST_CASE("the planner says what it can do") {
  const World world("s1_tight_hole");
  const TightPlanner planner(world.si);
  CHECK(planner.getName() == "TightPlanner");
  CHECK(planner.getSpecs().provingSolutionNonExistence);
  CHECK(planner.getSpecs().recognizedGoal == ob::GOAL_SAMPLEABLE_REGION);
  CHECK_FALSE(planner.getSpecs().approximateSolutions);
  CHECK_FALSE(planner.getSpecs().multithreaded);
  CHECK_FALSE(planner.getSpecs().optimizingPaths);
  CHECK_FALSE(planner.getSpecs().directed);
  CHECK(planner.getPlannerProgressProperties().count("preprocessing REAL") == 1);
  CHECK(planner.getPlannerProgressProperties().count("free cells INTEGER") == 1);
}

TEST_CASE("how far a planner has come may be asked while it solves, as OMPL's benchmark does", "[threads]") {
  const World world("s1_tight_hole");
  TightPlanner planner(world.si, free_space_builder(world.problem.scene()));
  planner.setKeepRoadmap(false);
  planner.setProblemDefinition(world.definition);
  const auto& progress = planner.getPlannerProgressProperties();
  for (int round = 0; round < 3; ++round) {
    std::atomic<bool> is_done = false;
    std::size_t told = 0;
    std::thread watcher([&] {
      do {
        for (const auto& property : progress) told += property.second().size();
      } while (!is_done);
    });
    const ob::PlannerStatus status = planner.solve(30.0);
    is_done = true;
    watcher.join();
    CHECK(told > 0);
    CHECK(status == ob::PlannerStatus::EXACT_SOLUTION);
    CHECK(std::stoul(progress.at("free cells INTEGER")()) > 0);
    planner.clear();
    CHECK(progress.at("free cells INTEGER")() == "0");
    world.definition->clearSolutionPaths();
  }
}

TEST_CASE("BIT* is not asked for counts that it makes of tables which it changes") {
  const World world("s1_tight_hole");
  for (const char* name : {"BITstar", "ABITstar"}) {
    const ob::PlannerPtr planner = make_ompl_planner(name, world.si);
    const auto& progress = planner->getPlannerProgressProperties();
    CHECK_FALSE(progress.empty());
    for (const auto& [property, value] : progress) {
      CAPTURE(name, property);
      CHECK(property.find("current") == std::string::npos);
    }
  }
}

TEST_CASE("declared parameters set what they name") {
  const World world("s14_two_ways");
  TightPlanner planner(world.si);
  std::map<std::string, std::string> values;
  planner.params().getParams(values);
  for (const char* name : {"min_dimension", "roomy", "clearance", "thorough", "digits", "keep_roadmap"}) {
    CHECK(values.count(name) == 1);
  }
  CHECK(planner.params().setParam("min_dimension", "3"));
  CHECK(planner.getMinDimension() == 3);
  CHECK(planner.params().setParam("roomy", "1"));
  CHECK(planner.getRoomy());
  CHECK(planner.params().setParam("clearance", "1"));
  CHECK(planner.getClearance());
  CHECK(planner.getThorough() == PathOptions().thorough);  // the command's default
  CHECK(planner.params().setParam("thorough", "0"));
  CHECK_FALSE(planner.getThorough());
  CHECK(planner.getDigits() == -1);
  CHECK_FALSE(planner.params().setParam("digits", "-2"));
  CHECK(planner.params().setParam("digits", "4"));
  CHECK(planner.getDigits() == 4);
  CHECK(planner.params().setParam("keep_roadmap", "0"));
  CHECK_FALSE(planner.getKeepRoadmap());
  planner.setProblemDefinition(world.definition);
  CHECK(planner.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(planner.getExactPath()->thinness.piece == 3);
}

TEST_CASE("termination is respected, also while the free space is built") {
  const World world("s1_tight_hole");
  TightPlanner planner(world.si, free_space_builder(world.problem.scene()));
  planner.setProblemDefinition(world.definition);
  CHECK(planner.solve(ob::plannerAlwaysTerminatingCondition()) == ob::PlannerStatus::TIMEOUT);
  int questions = 0;
  const ob::PlannerTerminationCondition soon([&questions] { return ++questions > 2; });
  CHECK(planner.solve(soon) == ob::PlannerStatus::TIMEOUT);
  CHECK(planner.getFreeSpace() == nullptr);
  CHECK_FALSE(world.definition->hasSolution());
  CHECK(planner.solve(ob::plannerNonTerminatingCondition()) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(planner.getFreeSpace() != nullptr);
}

TEST_CASE("a goal that cannot be sampled is not recognized, starts in collision are invalid, no start is misuse") {
  const World world("s1_tight_hole");
  TightPlanner planner(world.si);
  world.definition->setGoal(std::make_shared<Somewhere>(world.si));
  planner.setProblemDefinition(world.definition);
  CHECK(planner.solve(60.0) == ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE);
  world.definition->setGoal(world.setup.getGoal());
  world.definition->clearStartStates();
  planner.clear();
  CHECK_THROWS_AS(planner.solve(60.0), ompl::Exception);
  ob::ScopedState<> inside_the_wall(world.si);
  inside_the_wall = std::vector<double>{4, 0, 0};
  world.definition->addStartState(inside_the_wall);
  CHECK(planner.solve(60.0) == ob::PlannerStatus::INVALID_START);
}

TEST_CASE("the free space is built once, or for every query if it is not to be kept") {
  const World world("s1_tight_hole");
  int built = 0;
  const auto inner = free_space_builder(world.problem.scene());
  TightPlanner planner(world.si, [&](const Monitor& monitor) {
    ++built;
    return inner(monitor);
  });
  planner.setProblemDefinition(world.definition);
  for (int query = 0; query < 3; ++query) {
    planner.clear();
    CHECK(planner.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  }
  CHECK(built == 1);
  CHECK(planner.getPreprocessingTime() > 0);
  planner.setKeepRoadmap(false);
  for (int query = 0; query < 2; ++query) {
    planner.clear();
    CHECK(planner.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  }
  CHECK(built == 3);
}

TEST_CASE("rationals survive serialization as far as they fit") {
  const World world("s1_tight_hole");
  const auto* space = static_cast<const ExactTranslationSpace*>(world.si->getStateSpace().get());
  std::vector<char> bytes(space->getSerializationLength());
  ob::State* from = world.si->allocState();
  ob::State* to = world.si->allocState();
  const Rational long_one = Rational(1) / parse_rational("1e70") + Rational(1, 3);
  CHECK(long_one.get_den() > parse_rational("1e70"));
  for (const Rational3& position :
       {Rational3{Rational(1, 3), Rational(-22, 7), 0}, Rational3{1, Rational(1, 2), -3}, Rational3{long_one, -1, 2}}) {
    static_cast<StateType*>(from)->setExact(position);
    space->serialize(bytes.data(), from);
    space->deserialize(to, bytes.data());
    CHECK(static_cast<StateType*>(to)->exact() == position);
    CHECK(space->equalStates(from, to));
  }
  // Too long: the doubles are what is left.
  static_cast<StateType*>(from)->setExact({Rational(1) / parse_rational("1e90") + Rational(1, 3), 0, 0});
  space->serialize(bytes.data(), from);
  space->deserialize(to, bytes.data());
  CHECK(static_cast<StateType*>(to)->exact()[0] == exact_rational(1.0 / 3));
  world.si->freeState(from);
  world.si->freeState(to);
}

#ifdef PLANNER_TEST_STORAGE
TEST_CASE("planner data is stored and read back with its exact states") {
  Scene scene = load("s1_tight_hole");
  scene.start = Rational3{Rational(1, 3), Rational(1, 7), 1};
  const Problem problem(scene);
  TranslationPlanning setup(problem);
  REQUIRE(setup.solve(60.0));
  ob::PlannerData data(setup.getSpaceInformation());
  setup.getPlannerData(data);
  std::stringstream file;
  ob::PlannerDataStorage storage;
  storage.store(data, file);
  ob::PlannerData read(setup.getSpaceInformation());
  storage.load(file, read);
  REQUIRE(read.numVertices() == data.numVertices());
  CHECK(read.numEdges() == data.numEdges());
  for (unsigned int i = 0; i < data.numVertices(); ++i) {
    CHECK(setup.getStateSpace()->equalStates(data.getVertex(i).getState(), read.getVertex(i).getState()));
  }
}
#endif

TEST_CASE("whoever asks for a sampler gets one that knows the tight cells") {
  const World world("s1_tight_hole");
  CHECK(std::dynamic_pointer_cast<CellSampler>(world.si->getStateSpace()->allocDefaultStateSampler()) != nullptr);
  CHECK(std::dynamic_pointer_cast<CellSampler>(world.si->allocStateSampler()) != nullptr);
  CHECK(std::dynamic_pointer_cast<CellValidStateSampler>(world.si->allocValidStateSampler()) != nullptr);
  // Informed samplers, on which BIT* and its family stand, draw from it until there is a solution.
  const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(world.si);
  world.definition->setOptimizationObjective(objective);
  const ob::InformedSamplerPtr sampler = objective->allocInformedStateSampler(world.definition, 100);
  ob::State* state = world.si->allocState();
  int tight = 0;
  for (int i = 0; i < 100; ++i) {
    if (!sampler->sampleUniform(state, objective->infiniteCost())) continue;
    const CellId cell = world.problem.free_space().locate(static_cast<StateType*>(state)->point());
    if (world.problem.free_space().cells().dimension(cell) < 2) ++tight;
  }
  CHECK(tight > 5);
  world.si->freeState(state);
}

TEST_CASE("every planner of OMPL that the command knows runs on the exact free space") {
  const Problem problem(load("s8_fence"));
  unsigned solved = 0;
  for (const std::string& name : ompl_planner_names()) {
    INFO(name);
    const OmplOutcome outcome = run_ompl(problem, {name, 0.1, 1});
    CHECK((outcome.exit_code == 0 || outcome.exit_code == 4));
    CHECK(outcome.answer.path.has_value() == (outcome.exit_code == 0));
    solved += outcome.solved;
  }
  CHECK(solved >= 20);  // of 38, in a tenth of a second each
}

TEST_CASE("a benchmark log of several planners, ours among them, with our columns") {
  const Folder folder;
  const std::string log = folder.file("bench.log");
  const std::string planners = "RRTConnect,PRM,BITstar,KPIECE1";
  REQUIRE(test::planner(folder, scene("s1_tight_hole") + " --benchmark " + log + " --planners " + planners +
                                    " --time 0.05 --runs 2")
              .code == 0);
  const std::string text = text_of(log);
  CHECK_THAT(text, Catch::Contains("5 planners"));
  for (const char* word : {"geometric_TightPlanner", "geometric_RRTConnect", "geometric_PRM", "geometric_kBITstar",
                           "geometric_KPIECE1", "thinnest piece INTEGER", "thinnest junction INTEGER",
                           "proved infeasible BOOLEAN", "preprocessing REAL", "2 runs"}) {
    CHECK_THAT(text, Catch::Contains(word));
  }
}

}  // namespace
}  // namespace nef::planner::test
