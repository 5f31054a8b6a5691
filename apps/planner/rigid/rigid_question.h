// SPDX-License-Identifier: Apache-2.0
//
// What is asked about a robot that may turn about all axes.
#pragma once

#include "apps/planner/free_space/collision.h"
#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/scene/scene.h"

namespace nef::planner {

/// From where to where a rigid body is to move. Poses are those of the robot as it is in its own file.
struct RigidQuestion {
  RigidPose start;
  RigidPose goal;
};

/// The question of a scene whose robot turns freely (Scene::turns_freely). Throws InputError for another scene, and if
/// the start or the goal is missing.
RigidQuestion rigid_question_of(const Scene& scene);

/// What the robot hits at a pose, by Booleans of the turned robot; nothing if the pose is free.
std::optional<Collision> find_collision(const Scene& scene, const RigidPose& pose, const Monitor& monitor = {});

}  // namespace nef::planner
