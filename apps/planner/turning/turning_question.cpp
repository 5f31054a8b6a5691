// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/turning/turning_question.h"

#include "nef/base/error.h"
#include "nef/number/floor.h"

namespace nef::planner {

TurningQuestion question_of(const Scene& scene) {
  if (!scene.rotation) throw InputError(scene.name + ": the scene has no rotation");
  if (!scene.start || !scene.goal) throw InputError(scene.name + ": a robot that turns needs a start and a goal");
  const AxisRotation& r = *scene.rotation;
  TurningQuestion question;
  question.axis = TurningAxis(r.axis);
  question.low = question.axis.turn_of_degrees(r.low);
  question.high = question.axis.turn_of_degrees(r.high);
  const auto in_range = [&](const Rational& degrees) {
    Turn turn = question.axis.turn_of_degrees(degrees);
    if (turn >= question.low && turn <= question.high) return turn;
    const Turn moved = moved_above(turn, question.low);
    return moved <= question.high ? moved : turn;
  };
  question.start = {*scene.start, in_range(r.start)};
  question.goal = {*scene.goal, in_range(r.goal)};
  return question;
}

}  // namespace nef::planner
