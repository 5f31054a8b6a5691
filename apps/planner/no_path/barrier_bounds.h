// SPDX-License-Identifier: Apache-2.0
//
// The positions among which a barrier is looked for.
#pragma once

#include <array>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/no_path/blocking_pairs.h"
#include "apps/planner/proofs/path_proof.h"

namespace nef::planner {

/// Bounds for positions of a reference point of the robot: around all those that the claim's box allows, or, without
/// one, around start, goal, obstacles and the robot beside them. The coordinates are doubles.
struct BarrierBounds {
  /// `reach`: no point of the robot is farther from the reference point.
  BarrierBounds(const PathProof::Claim& claim, const Rational3& reference, double reach);

  std::array<Rational3, 2> exact;
  PositionBox rough;              ///< the same
  std::array<bool, 3> is_flat{};  ///< the claim's box has no extent along an axis, which need not be cut
};

/// Where a point of the robot is at a pose.
Vector3d reference_position(const RigidPose& pose, const Rational3& reference);

}  // namespace nef::planner
