// SPDX-License-Identifier: Apache-2.0
//
// What a claim that there is no path says about the rotations of a scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/planner/rigid/rigid_motion.h"
#include "apps/planner/scene/scene.h"
#include "apps/planner/turning/turn.h"

namespace nef::planner {

/// What a claim about a scene whose robot turns is about.
struct RotationClaim {
  RigidPose start;
  RigidPose goal;
  std::vector<Quaternion> chain;  ///< of arcs (Orientations::along); empty: all rotations
  std::vector<Turn> turns;        ///< of the quaternions in the chain
  /// The numbers of start and goal in the chain, if the range is wider than a full turn: angles that differ by one are
  /// different then, and their quaternions are not.
  std::optional<std::array<std::uint32_t, 2>> places;
};

/// That of a scene whose robot turns freely (the poses are those of the robot in its own file), or about one axis: then
/// the chain has the ends of the range, start, goal, and each quarter turn. Throws InputError if the robot does not
/// turn, or start or goal is missing.
RotationClaim rotation_claim_of(const Scene& scene);

}  // namespace nef::planner
