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
  // normal * x <= offset, in integers: their products need no common divisors.
  struct Face {
    Integer3 normal;
    Integer offset;
  };
  // Those of a piece, seen from a point; none for a flat piece.
  static std::vector<Face> faces_of(const std::vector<Rational3>& vertices, const Rational3& seen_from);

  const Orientations& orientations_;
  std::vector<std::vector<Face>> robot_;  // seen from the reference
  std::vector<std::vector<Face>> obstacles_;
};

/// The product of the matrix and a vector, without the division.
Integer3 scaled_product(const ScaledMatrix<Integer>& m, const Integer3& v);

}  // namespace nef::planner
