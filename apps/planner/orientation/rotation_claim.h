// SPDX-License-Identifier: Apache-2.0
//
// What a claim that there is no path says about the rotations of a scene.
#pragma once

#include <vector>

#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/scene/scene.h"

namespace nef::planner {

/// What a claim about a scene whose robot turns is about.
struct RotationClaim {
  RigidPose start;
  RigidPose goal;
  std::vector<Quaternion> chain;  ///< of arcs (Orientations::along); empty: all rotations
};

/// That of a scene whose robot turns freely (the poses are those of the robot in its own file), or about one axis: then
/// the chain has the ends of the range, start, goal, and each quarter turn. Throws InputError if the robot does not
/// turn, start or goal is missing, or the range is wider than a full turn: angles that differ by one are different
/// then, and quaternions are not.
RotationClaim rotation_claim_of(const Scene& scene);

}  // namespace nef::planner
