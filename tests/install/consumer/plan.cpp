// SPDX-License-Identifier: Apache-2.0
#include <ompl/util/Console.h>
#include <iostream>
#include "apps/planner/ompl/translation_planning.h"
int main() {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  // A unit cube before a hole of its own size.
  nef::planner::TranslationPlanning setup;
  setup.addObstacle(nef::subtract(nef::make_box({4, -9, -9}, {5, 9, 9}), nef::make_box({4, 1, 1}, {5, 2, 2})));
  setup.setRobot(nef::make_box({0, 0, 0}, {1, 1, 1}));
  setup.setEnvironmentBounds({-8, -8, -8}, {16, 8, 8});
  setup.setExactStartAndGoal({1, 0, 0}, {7, 3, 2});
  if (setup.solve(60.0) && setup.haveExactSolutionPath()) std::cout << "a path\n";
}
