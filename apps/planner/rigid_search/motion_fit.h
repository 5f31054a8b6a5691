// SPDX-License-Identifier: Apache-2.0
//
// Positions for a motion whose rotations are given, as far from obstacles as can be found nearby.
#pragma once

#include <span>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/motion_checker.h"

namespace nef::planner {

/// Fits motions between obstacles, in doubles: what it returns is a guess, which a MotionChecker has to certify. Const
/// and safe to share between threads.
class MotionFit {
 public:
  /// The checker must outlive it.
  explicit MotionFit(const MotionChecker& checker);

  /// False if robot and obstacles have too many pieces for this to pay.
  [[nodiscard]] bool is_worthwhile() const { return worthwhile_; }

  /// Moves the positions of a motion through poses with these rotations, one position each, so that the smallest gap
  /// along it grows: by no more than about `reach` each, and no further than to gaps of `margin`. Returns the smallest
  /// gap that is seen at these poses and in the middle between them, negative if bodies overlap. A few linear programs
  /// with three variables a pose, and a constraint for each time and each pair of pieces that is near then. `monitor`
  /// can stop it (Interrupted).
  double fit(std::span<const Quaternion> rotations, std::vector<Vector3d>& positions, double reach, double margin,
             const Monitor& monitor = {}) const;

 private:
  struct Piece {
    std::vector<Vector3d> points;
    std::vector<Vector3d> normals;  // outward; both of a flat piece
    std::vector<Vector3d> edges;    // directions, one of each pair of opposite ones
    Vector3d low{0, 0, 0};          // corners of the box around it
    Vector3d high{0, 0, 0};
    Vector3d middle{0, 0, 0};
    double radius = 0;
  };
  struct Pair;
  struct Turns;
  static std::vector<Piece> pieces_of(const RigidBody& body);
  void find_pairs(const Turns& turns, const std::vector<Vector3d>& positions, double reach, std::vector<Pair>& pairs,
                  const Monitor& monitor) const;
  // The plane with the largest gap; or any that leaves enough.
  static Pair best_pair(const Eigen::Matrix3d& turn, const Vector3d& position, const Piece& robot,
                        const Piece& obstacle, double enough);
  [[nodiscard]] std::vector<Vector3d> step(const std::vector<Pair>& pairs, const std::vector<Vector3d>& positions,
                                           double trust, double margin) const;

  const MotionChecker* checker_;
  std::vector<Piece> robot_;
  std::vector<Piece> obstacles_;
  bool worthwhile_ = false;
};

}  // namespace nef::planner
