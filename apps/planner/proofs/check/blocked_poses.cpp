// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/proofs/check/blocked_poses.h"

#include <algorithm>

#include "nef/construct/convex_hull.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

std::vector<HalfSpace> faces_of(const std::vector<Rational3>& vertices) {
  const Hull hull = hull_of(vertices);
  return hull.dimension < 3 ? std::vector<HalfSpace>{} : half_spaces_of(hull.mesh);
}

// An integer vector that is a positive multiple of a rational one: products of those need no common divisors.
struct Scaled {
  Integer3 vector;
  Integer scale;
};

Scaled scaled(const Rational3& v) {
  const Integer scale = common_denominator(v);
  return {times(v, scale), scale};
}

}  // namespace

Rational3 scaled_product(const ScaledMatrix<Rational>& m, const Rational3& v) {
  Rational3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = dot(m.rows[i], v);
  return result;
}

BlockedPoses::BlockedPoses(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference)
    : orientations_(orientations) {
  for (const std::vector<Rational3>& piece : claim.robot) {
    std::vector<Rational3> shifted;
    for (const Rational3& v : piece) shifted.push_back(minus(v, reference));
    robot_.push_back(faces_of(shifted));
  }
  for (const std::vector<Rational3>& piece : claim.obstacles) obstacles_.push_back(faces_of(piece));
}

std::optional<std::string> BlockedPoses::complaint(const OrientationBox<Rational>& box,
                                                   std::span<const Rational3> positions, std::uint32_t robot,
                                                   std::uint32_t obstacle, std::span<const Rational3> common) const {
  if (robot >= robot_.size() || obstacle >= obstacles_.size())
    return "what is blocked names a piece that does not exist";
  const std::vector<HalfSpace>& piece = robot_[robot];
  const std::vector<HalfSpace>& faces = obstacles_[obstacle];
  if (piece.empty() || faces.empty()) return "a flat piece blocks nothing";
  if (common.size() != positions.size()) return "what is blocked has a point of both pieces for each corner";
  const std::vector<ScaledMatrix<Rational>> matrices = mixed_rotations(orientations_, box);
  if (matrices.empty()) return "what is blocked has too many orientations";
  std::vector<Scaled> inside;  // each point, seen from its corner
  for (std::size_t i = 0; i < common.size(); ++i) {
    inside.push_back(scaled(minus(common[i], positions[i])));
    const bool is_in = std::all_of(faces.begin(), faces.end(),
                                   [&](const HalfSpace& face) { return dot(face.normal, common[i]) <= face.offset; });
    if (!is_in) return "a point of both pieces is not in the obstacle";
  }
  for (const HalfSpace& face : piece) {
    for (const ScaledMatrix<Rational>& m : matrices) {
      const Scaled normal = scaled(scaled_product(m, face.normal));
      const Rational most = face.offset * m.scale * normal.scale;
      for (const Scaled& point : inside) {
        if (dot(normal.vector, point.vector) * most.get_den() >= most.get_num() * point.scale) {
          return "a point of both pieces is not inside the robot";
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace nef::planner
