// SPDX-License-Identifier: Apache-2.0
//
// What shows that two pieces overlap at all poses of some set.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/planner/intersection/hulls_apart.h"
#include "apps/planner/orientation/orientation_cells.h"
#include "apps/planner/proofs/path_proof.h"

namespace nef::planner {

/// The pieces of a claim by their half-spaces. The orientations must outlive it.
class BlockedPoses {
 public:
  /// Positions are those of a point of the robot, the reference.
  BlockedPoses(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference);

  /// What is wrong with the proof that a piece of the robot overlaps an obstacle's at all orientations of a box, and at
  /// all positions in the hull of some; nothing if it holds. `common` has for each of these positions a point of the
  /// obstacle, which must be inside the inner piece (mixed_rotations) there: obstacle and inner piece are convex, so
  /// all positions between them have such a point, and the inner piece is in the turned robot.
  [[nodiscard]] std::optional<std::string> complaint(const OrientationBox<Rational>& box,
                                                     std::span<const Rational3> positions, std::uint32_t robot,
                                                     std::uint32_t obstacle, std::span<const Rational3> common) const;

 private:
  const Orientations& orientations_;
  std::vector<std::vector<HalfSpace>> robot_;  // seen from the reference; none for flat pieces
  std::vector<std::vector<HalfSpace>> obstacles_;
};

/// The product of the matrix and a vector, without the division.
Rational3 scaled_product(const ScaledMatrix<Rational>& m, const Rational3& v);

}  // namespace nef::planner
