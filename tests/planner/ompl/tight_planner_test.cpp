// SPDX-License-Identifier: Apache-2.0
//
// The OMPL classes: OMPL's own sanity checks, exact states, validity, samplers, proofs, and stock planners through
// passages of width zero.
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <catch2/catch.hpp>
#include <sstream>

#include "apps/planner/command/runs/ompl_runs.h"
#include "apps/planner/ompl/cell_sampler.h"
#include "apps/planner/ompl/nef_validity.h"
#include "apps/planner/ompl/ompl_planners.h"
#include "apps/planner/ompl/translation_planning.h"
#include "nef/base/error.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;
using StateType = ExactTranslationSpace::StateType;

struct QuietLog {
  QuietLog() { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }
};
const QuietLog quiet_log;

// An owned state at an exact position.
struct At {
  At(const ob::SpaceInformationPtr& information, const Rational3& position) : si(information), state(si->allocState()) {
    static_cast<StateType*>(state)->setExact(position);
  }
  ~At() { si->freeState(state); }
  At(const At&) = delete;
  At& operator=(const At&) = delete;
  ob::SpaceInformationPtr si;
  ob::State* state;
};

TEST_CASE("the state space passes OMPL's sanity checks and keeps rationals") {
  auto space = std::make_shared<ExactTranslationSpace>();
  ob::RealVectorBounds bounds(3);
  bounds.setLow(-2);
  bounds.setHigh(3);
  space->setBounds(bounds);
  space->setup();
  CHECK_NOTHROW(space->sanityChecks());
  auto si = std::make_shared<ob::SpaceInformation>(space);
  const Rational third(1, 3);
  const At a(si, {third, 1, 0});
  const At b(si, {third, 2, 0});
  const At c(si, {0, 0, 0});
  const auto* exact = static_cast<StateType*>(a.state);
  CHECK(exact->hasExact());
  CHECK(exact->exact() == Rational3{third, 1, 0});
  // Equal doubles, different numbers.
  static_cast<StateType*>(c.state)->values[0] = exact->values[0];
  static_cast<StateType*>(c.state)->values[1] = 1;
  CHECK_FALSE(space->equalStates(a.state, c.state));
  space->copyState(c.state, a.state);
  CHECK(space->equalStates(a.state, c.state));
  space->interpolate(a.state, b.state, 0.25, c.state);
  CHECK(static_cast<StateType*>(c.state)->exact() == Rational3{third, Rational(5, 4), 0});
  // Doubles written behind its back count.
  static_cast<StateType*>(c.state)->values[0] = 0.5;
  CHECK(static_cast<StateType*>(c.state)->exact()[0] == Rational(1, 2));
}

TEST_CASE("states and motions are judged exactly") {
  const Problem problem(load("s1_tight_hole"));
  TranslationPlanning setup(problem);
  setup.setup();
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  const At room(si, {1, 1, 1});
  const At tight(si, {4, 1, 1});
  const At beside(si, {4, 1, Rational(1) + Rational(1, 1000000000)});
  const At far(si, {7, 1, 1});
  const At off(si, {7, 1, Rational(11, 10)});
  CHECK(si->isValid(room.state));
  CHECK(si->isValid(tight.state));
  CHECK_FALSE(si->isValid(beside.state));
  CHECK(si->checkMotion(room.state, far.state));
  CHECK_FALSE(si->checkMotion(room.state, off.state));
  CHECK(si->getStateValidityChecker()->clearance(tight.state) == 0);
  CHECK(si->getStateValidityChecker()->clearance(room.state) == Approx(1));
  CHECK(si->getStateValidityChecker()->clearance(beside.state) < 0);
  const At last(si, {0, 0, 0});
  std::pair<ob::State*, double> valid(last.state, -1.0);
  CHECK_FALSE(si->checkMotion(room.state, off.state, valid));
  // The line from (1,1,1) to (7,1,11/10) leaves the room at x = 3.
  CHECK(static_cast<StateType*>(last.state)->exact() == Rational3{3, 1, Rational(31, 30)});
  CHECK(valid.second == Approx(1.0 / 3));
  CHECK(si->isValid(last.state));
}

TEST_CASE("a wall thinner than any step is no way through, unlike for OMPL's default check") {
  Scene scene = load("s5_closed_box");
  const Problem problem(scene);
  TranslationPlanning setup(problem);
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation()));
  setup.solve(0.2);
  CHECK_FALSE(setup.haveExactSolutionPath());
}

TEST_CASE("TightPlanner solves every solvable scene through OMPL, before and after simplification") {
  for (const char* name : {"s1_tight_hole", "s2_tight_slot", "s4_rooms_at_an_edge", "s7_one_box", "s8_fence",
                           "s9_gate_and_rail", "s10_t_slot", "s14_two_ways", "ztunnel_1", "peg"}) {
    INFO(name);
    const Problem problem(load(name));
    TranslationPlanning setup(problem);
    CHECK(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
    REQUIRE(setup.haveExactSolutionPath());
    CHECK(setup.getSolutionPath().check());
    setup.simplifySolution();
    CHECK(setup.getSolutionPath().check());
    setup.getSolutionPath().interpolate(50);
    CHECK(setup.getSolutionPath().check());
  }
}

// Keeps what is written to OMPL's console.
class KeptLog : public ompl::msg::OutputHandler {
 public:
  KeptLog() : previous_(ompl::msg::getOutputHandler()) {
    ompl::msg::useOutputHandler(this);
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  }
  ~KeptLog() override {
    ompl::msg::useOutputHandler(previous_);
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  }
  KeptLog(const KeptLog&) = delete;
  KeptLog& operator=(const KeptLog&) = delete;
  void log(const std::string& line, ompl::msg::LogLevel /*level*/, const char* /*file*/, int /*line*/) override {
    text += line + "\n";
  }
  std::string text;

 private:
  ompl::msg::OutputHandler* previous_;
};

TEST_CASE("an optimization objective other than length is said to be ignored") {
  for (const bool clearance : {false, true}) {
    const Problem problem(load("s7_one_box"));
    TranslationPlanning setup(problem);
    const auto& si = setup.getSpaceInformation();
    if (clearance) {
      setup.setOptimizationObjective(std::make_shared<ob::MaximizeMinClearanceObjective>(si));
    } else {
      setup.setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(si));
    }
    const KeptLog log;
    CHECK(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
    CHECK((log.text.find("is ignored") != std::string::npos) == clearance);
  }
}

TEST_CASE("TightPlanner proves infeasibility") {
  for (const char* name : {"s1_narrower", "s5_closed_box", "s10_capped", "s12_two_abutting_boxes", "s12_point_robot"}) {
    INFO(name);
    const Problem problem(load(name));
    TranslationPlanning setup(problem);
    const ob::PlannerStatus status = setup.solve(60.0);
    CHECK_FALSE(status);
    CHECK_FALSE(setup.haveSolutionPath());
    REQUIRE(setup.getProblemDefinition()->hasSolutionNonExistenceProof());
    const auto proof =
        std::static_pointer_cast<DisconnectionProof>(setup.getProblemDefinition()->getSolutionNonExistenceProof());
    CHECK(proof->verify());
    CHECK_FALSE(proof->isRestricted());
    CHECK(proof->startComponents() != proof->goalComponents());
    CHECK_FALSE(proof->separatingFacets().empty());
    std::ostringstream text;
    proof->print(text);
    CHECK(text.str().find("No path") != std::string::npos);
  }
}

TEST_CASE("statuses of wrong questions, several goals, many queries on one free space") {
  const Problem problem(load("s1_tight_hole"));
  TranslationPlanning setup(problem);
  setup.setExactStartAndGoal({4, 0, 0}, {7, 1, 1});
  CHECK(setup.solve(60.0) == ob::PlannerStatus::INVALID_START);
  setup.clear();
  setup.setExactStartAndGoal({1, 1, 1}, {4, 0, 0});
  CHECK(setup.solve(60.0) == ob::PlannerStatus::INVALID_GOAL);
  setup.clear();
  // One goal in another component, one in reach.
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  auto goals = std::make_shared<ob::GoalStates>(si);
  const At outside(si, {-4, 0, 0});
  const At inside(si, {7, 1, 1});
  goals->addState(outside.state);
  goals->addState(inside.state);
  setup.setGoal(goals);
  CHECK(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const FreeSpace* before = setup.getTightPlanner()->getFreeSpace().get();
  setup.clear();
  setup.setExactStartAndGoal({Rational(1, 3), 1, 1}, {7, Rational(1, 3), 1});
  CHECK(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
  CHECK(setup.getTightPlanner()->getFreeSpace().get() == before);
  CHECK(setup.getTightPlanner()->params().hasParam("min_dimension"));
  setup.clear();
  setup.getTightPlanner()->params().setParam("min_dimension", "3");
  setup.solve(60.0);
  const auto proof =
      std::static_pointer_cast<DisconnectionProof>(setup.getProblemDefinition()->getSolutionNonExistenceProof());
  REQUIRE(proof);
  CHECK(proof->isRestricted());
}

TEST_CASE("the roadmap is exported as planner data") {
  const Problem problem(load("s1_tight_hole"));
  TranslationPlanning setup(problem);
  REQUIRE(setup.solve(60.0));
  ob::PlannerData data(setup.getSpaceInformation());
  setup.getPlannerData(data);
  CHECK(data.numVertices() > problem.free_space().roadmap().portals().size());
  CHECK(data.numEdges() > 0);
  std::ostringstream text;
  data.printGraphML(text);
  CHECK(text.str().find("graphml") != std::string::npos);
}

TEST_CASE("samplers draw valid exact states from the tight cells, near variants included") {
  const Problem problem(load("s1_tight_hole"));
  TranslationPlanning setup(problem);
  setup.setup();
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  const FreeSpace& free = problem.free_space();
  const auto is_tight = [&](const ob::State* state) {
    const CellId cell = free.locate(static_cast<const StateType*>(state)->point());
    return free.is_free(cell) && free.cells().dimension(cell) < 2;
  };
  const At state(si, {0, 0, 0});
  const At near(si, {4, 1, 1});
  const ob::StateSamplerPtr sampler = si->allocStateSampler();
  std::array<int, 4> tight{};
  for (int i = 0; i < 400; ++i) {
    sampler->sampleUniform(state.state);
    tight[0] += is_tight(state.state) ? 1 : 0;
    sampler->sampleUniformNear(state.state, near.state, 1.5);
    tight[1] += is_tight(state.state) ? 1 : 0;
    sampler->sampleGaussian(state.state, near.state, 0.5);
    tight[2] += is_tight(state.state) ? 1 : 0;
  }
  const ob::ValidStateSamplerPtr valid = si->allocValidStateSampler();
  for (int i = 0; i < 100; ++i) {
    REQUIRE(valid->sample(state.state));
    CHECK(si->isValid(state.state));
    tight[3] += is_tight(state.state) ? 1 : 0;
  }
  for (const int count : tight) CHECK(count > 10);
}

TEST_CASE("stock planners get through a passage of width zero by these samplers") {
  const Problem problem(load("s1_tight_hole"));
  for (const char* name : {"RRTConnect", "PRM"}) {
    INFO(name);
    OmplRequest request;
    request.planner = name;
    request.seconds = 5;
    const OmplOutcome outcome = run_ompl(problem, request);
    CHECK(outcome.exit_code == 0);
    REQUIRE(outcome.answer.path.has_value());
    CHECK(outcome.answer.path->thinness.piece == 1);
  }
  CHECK_THROWS_AS(make_ompl_planner("Dijkstra", TranslationPlanning(problem).getSpaceInformation()), InputError);
}

}  // namespace
}  // namespace nef::planner::test
