// SPDX-License-Identifier: Apache-2.0
//
// What shows that two pieces overlap at all poses of some set.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/planner/intersection/hulls_apart.h"
#include "apps/planner/orientation/orientation_cells.h"
#include "apps/planner/proofs/path_proof.h"
#include "nef/number/int128.h"

namespace nef::planner {

/// The pieces of a claim by their half-spaces. The orientations must outlive it.
class BlockedPoses {
 public:
  /// Positions are those of a point of the robot, the reference.
  BlockedPoses(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference);

  /// What is wrong with the proof that a piece of the robot overlaps an obstacle's at all orientations of a box, and at
  /// all positions in the hull of some; nothing if it holds. `common` has for each of these positions a point of the
  /// obstacle, which must be inside the inner piece (mixed_rotations) there: obstacle and inner piece are convex, so
  /// all positions between them have such a point, and the inner piece is in the turned robot. If there is a `drift`
  /// for each parameter of the box, these points drift by so much while the parameter goes from the middle to its upper
  /// end: they must be in the obstacle, and inside the robot, all the way. For one of the robot's faces this is the
  /// sign of a polynomial in the parameters, whose Bernstein coefficients are looked at (raised_form.h).
  [[nodiscard]] std::optional<std::string> complaint(const OrientationBox<Rational>& box,
                                                     std::span<const Rational3> positions, std::uint32_t robot,
                                                     std::uint32_t obstacle, std::span<const Rational3> common,
                                                     std::span<const Rational3> drift = {}) const;

 private:
  // normal * x <= offset, in integers: their products need no common divisors.
  template <class Number>
  struct Face {
    std::array<Number, 3> normal;
    Number offset;
  };
  struct Faces {
    std::vector<Face<Integer>> exact;
    std::vector<Face<Int128>> words;  // the same, if no number has more bits than a word
    std::size_t bits = 0;             // of the longest number
  };
  // A box of poses in one chart, and points of both pieces, in integers: positions and points times `unit`.
  template <class Number>
  struct Question;
  template <class Number>
  static std::optional<std::string> complaint(const std::vector<Face<Number>>& robot,
                                              const std::vector<Face<Number>>& obstacle,
                                              const Question<Number>& question);
  template <class Number>
  static bool drifts_inside(const std::vector<Face<Number>>& robot, const std::vector<ScaledMatrix<Number>>& matrices,
                            const std::vector<std::array<Number, 3>>& seen, const Question<Number>& question);
  // The question in words, if that cannot overflow.
  static std::optional<Question<Int128>> in_words(const Question<Integer>& question, std::size_t face_bits);

  // Those of a piece, seen from a point; none for a flat piece.
  static Faces faces_of(const std::vector<Rational3>& vertices, const Rational3& seen_from);

  const Orientations& orientations_;
  std::vector<Faces> robot_;  // seen from the reference
  std::vector<Faces> obstacles_;
};

/// The product of the matrix and a vector, without the division.
Integer3 scaled_product(const ScaledMatrix<Integer>& m, const Integer3& v);

}  // namespace nef::planner
