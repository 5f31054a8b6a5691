// SPDX-License-Identifier: Apache-2.0
//
// How to use the exact planner from one's own OMPL code: a cube and a wall with a hole of exactly its
// size. First the exact planner, then RRTConnect on the same exact free space, then a question whose
// answer is no, with the proof.
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <iostream>
#include <string>

#include "apps/planner/ompl/translation_planning.h"

namespace {

using nef::Rational;
using nef::planner::DisconnectionProof;
using nef::planner::TranslationPlanning;

nef::Polyhedron wall_with_hole(const Rational& height) {
  const nef::Polyhedron wall = nef::make_box({4, -9, -9}, {5, 9, 9});
  return nef::subtract(wall, nef::make_box({4, 1, 1}, {5, 2, Rational(1 + height)}));
}

void report(const char* who, TranslationPlanning& setup, ompl::base::PlannerStatus status) {
  // OMPL has a status for a proof that there is no path only from 1.6 on.
  const bool is_infeasible = setup.getProblemDefinition()->hasSolutionNonExistenceProof();
  std::cout << who << ": " << (is_infeasible ? std::string("Infeasible") : status.asString());
  if (setup.haveExactSolutionPath()) {
    std::cout << ", length " << setup.getSolutionPath().length() << ", checked "
              << (setup.getSolutionPath().check() ? "yes" : "no");
  }
  std::cout << '\n';
}

void ask(TranslationPlanning& setup) {
  setup.setRobot(nef::make_box({0, 0, 0}, {1, 1, 1}));
  setup.setEnvironmentBounds({-8, -8, -8}, {16, 8, 8});
  setup.setExactStartAndGoal({1, Rational(1, 2), Rational(1, 3)}, {7, 3, 2});
}

}  // namespace

int main() {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);

  TranslationPlanning setup;
  setup.addObstacle(wall_with_hole(1));
  ask(setup);
  report("TightPlanner", setup, setup.solve(1.0));
  std::cout << "thinnest piece " << setup.getTightPlanner()->getExactPath()->thinness.piece << '\n';

  // The samplers of the exact space draw from the hole as well, so OMPL's planners have a chance.
  setup.clear();
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation()));
  report("RRTConnect", setup, setup.solve(5.0));

  TranslationPlanning narrow;
  narrow.addObstacle(wall_with_hole(Rational(999999, 1000000)));
  ask(narrow);
  report("TightPlanner", narrow, narrow.solve(1.0));
  const auto proof = narrow.getProblemDefinition()->getSolutionNonExistenceProof();
  static_cast<const DisconnectionProof&>(*proof).print(std::cout);
  return setup.haveExactSolutionPath() && narrow.getProblemDefinition()->hasSolutionNonExistenceProof() ? 0 : 1;
}
