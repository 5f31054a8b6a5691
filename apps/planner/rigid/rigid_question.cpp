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

std::optional<Collision> find_collision(const Scene& scene, const RigidPose& pose, const Monitor& monitor) {
  Scene there = scene;
  there.robot = transform(scene.robot, map_of({Rational3{}, pose.quaternion}), monitor);
  return find_collision(there, pose.position, monitor);
}

}  // namespace nef::planner
