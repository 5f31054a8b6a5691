// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning_ompl/turning_space.h"

#include <ompl/base/SpaceInformation.h>
#include <ompl/util/Console.h>

#include <catch2/catch.hpp>

#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

namespace ob = ompl::base;

TEST_CASE("the space of poses passes OMPL's sanity checks and keeps exact poses") {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  for (const Rational3& direction : {Rational3{0, 0, 1}, Rational3{1, 1, 1}}) {
    auto space = std::make_shared<TurningSpace>(TurningAxis(direction), 2.0);
    ob::RealVectorBounds bounds(3);
    bounds.setLow(-3);
    bounds.setHigh(3);
    space->setBounds(bounds);
    space->setup();
    CHECK_NOTHROW(space->sanityChecks());
    ob::State* a = space->allocState();
    ob::State* b = space->allocState();
    const Pose pose{{ratio(1, 3), 2, 0}, 1 + ratio(1, 7)};
    space->setPose(a, pose);
    CHECK(space->pose(a).position == pose.position);
    CHECK(space->pose(a).turn == pose.turn);
    space->copyState(b, a);
    CHECK(space->equalStates(a, b));
    CHECK(space->pose(b).turn == pose.turn);
    space->setPose(b, {{1, 1, 1}, 3 + ratio(1, 7)});  // OMPL's angles end at half a turn
    CHECK(space->pose(b).turn == ratio(1, 7) - 1);
    // Translations keep the turn.
    space->setPose(b, {{1, 1, 1}, pose.turn});
    ob::State* middle = space->allocState();
    space->interpolate(a, b, 0.5, middle);
    CHECK(space->pose(middle).turn == pose.turn);
    CHECK(space->pose(middle).position == Rational3{ratio(2, 3), ratio(3, 2), ratio(1, 2)});
    // An angle that somebody writes counts.
    auto* angle = middle->as<ob::CompoundState>()->as<TurnSpace::StateType>(1);
    angle->value = 0.25;
    CHECK(space->axis().degrees_of(space->pose(middle).turn) == Approx(0.25 * 180 / M_PI));
    for (ob::State* state : {a, b, middle}) space->freeState(state);
  }
}

}  // namespace
}  // namespace nef::planner::test
