// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/rigid_question.h"

#include "nef/base/error.h"

namespace nef::planner {

RigidQuestion rigid_question_of(const Scene& scene) {
  if (!scene.turns_freely || !scene.quaternions) {
    throw InputError(scene.name + ": the robot does not turn freely; that takes \"rotation\": \"SO(3)\"");
  }
  if (!scene.start || !scene.goal) throw InputError(scene.name + ": a robot that turns needs a start and a goal");
  const auto& [start, goal] = *scene.quaternions;
  return {{*scene.start, start}, {*scene.goal, goal}};
}

}  // namespace nef::planner
