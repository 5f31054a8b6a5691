// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/proofs/check/blocked_poses.h"

#include <algorithm>

#include "nef/construct/convex_hull.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/number/int128.h"

namespace nef::planner {
namespace {

// An integer vector that is a positive multiple of a rational one: products of those need no common divisors.
struct Scaled {
  Integer3 vector;
  Integer scale;
};

Scaled scaled(const Rational3& v) {
  const Integer scale = common_denominator(v);
  return {times(v, scale), scale};
}

// The same in machine words, if it is short.
struct ShortVector {
  std::array<std::int64_t, 3> vector{};
  std::int64_t scale = 0;
};

std::optional<ShortVector> short_vector(const Integer3& vector, const Integer& scale) {
  constexpr std::size_t kMostBits = 58;
  for (const Integer* x : {&vector[0], &vector[1], &vector[2], &scale}) {
    if (mpz_sizeinbase(x->get_mpz_t(), 2) > kMostBits) return std::nullopt;
  }
  return ShortVector{{vector[0].get_si(), vector[1].get_si(), vector[2].get_si()}, scale.get_si()};
}

// Whether normal * point < most for all points. Nearly all vectors are short; those that are not are compared by
// Integer, the twin of this.
bool all_are_below(const Integer3& normal, const Integer& most, const std::vector<Scaled>& points,
                   const std::vector<std::optional<ShortVector>>& short_points) {
  const std::optional<ShortVector> plane = short_vector(normal, most);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (plane && short_points[i]) {
      const ShortVector& point = *short_points[i];
      Int128 at = 0;
      for (std::size_t k = 0; k < 3; ++k) at += Int128{plane->vector[k]} * point.vector[k];
      if (at >= Int128{plane->scale} * point.scale) return false;
    } else if (dot(normal, points[i].vector) >= most * points[i].scale) {
      return false;
    }
  }
  return true;
}

}  // namespace

Integer3 scaled_product(const ScaledMatrix<Integer>& m, const Integer3& v) {
  return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}

std::vector<BlockedPoses::Face> BlockedPoses::faces_of(const std::vector<Rational3>& vertices,
                                                       const Rational3& seen_from) {
  std::vector<Rational3> shifted;
  for (const Rational3& v : vertices) shifted.push_back(minus(v, seen_from));
  const Hull hull = hull_of(shifted);
  std::vector<Face> result;
  if (hull.dimension < 3) return result;
  for (const HalfSpace& face : half_spaces_of(hull.mesh)) {
    const Integer scale = lcm(common_denominator(face.normal), face.offset.get_den());
    result.push_back({times(face.normal, scale), Integer(scale / face.offset.get_den() * face.offset.get_num())});
  }
  return result;
}

BlockedPoses::BlockedPoses(const PathProof::Claim& claim, const Orientations& orientations, const Rational3& reference)
    : orientations_(orientations) {
  for (const std::vector<Rational3>& piece : claim.robot) robot_.push_back(faces_of(piece, reference));
  for (const std::vector<Rational3>& piece : claim.obstacles) obstacles_.push_back(faces_of(piece, {0, 0, 0}));
}

std::optional<std::string> BlockedPoses::complaint(const OrientationBox<Rational>& box,
                                                   std::span<const Rational3> positions, std::uint32_t robot,
                                                   std::uint32_t obstacle, std::span<const Rational3> common) const {
  if (robot >= robot_.size() || obstacle >= obstacles_.size())
    return "what is blocked names a piece that does not exist";
  const std::vector<Face>& piece = robot_[robot];
  const std::vector<Face>& faces = obstacles_[obstacle];
  if (piece.empty() || faces.empty()) return "a flat piece blocks nothing";
  if (common.size() != positions.size()) return "what is blocked has a point of both pieces for each corner";
  const std::vector<ScaledMatrix<Integer>> matrices = mixed_rotations(orientations_, box);
  if (matrices.empty()) return "what is blocked has too many orientations";
  std::vector<Scaled> inside;  // each point, seen from its corner
  std::vector<std::optional<ShortVector>> short_inside;
  for (std::size_t i = 0; i < common.size(); ++i) {
    inside.push_back(scaled(minus(common[i], positions[i])));
    short_inside.push_back(short_vector(inside.back().vector, inside.back().scale));
    const Scaled point = scaled(common[i]);
    const bool is_in = std::all_of(faces.begin(), faces.end(), [&](const Face& face) {
      return dot(face.normal, point.vector) <= face.offset * point.scale;
    });
    if (!is_in) return "a point of both pieces is not in the obstacle";
  }
  for (const Face& face : piece) {
    for (const ScaledMatrix<Integer>& m : matrices) {
      if (!all_are_below(scaled_product(m, face.normal), face.offset * m.scale, inside, short_inside)) {
        return "a point of both pieces is not inside the robot";
      }
    }
  }
  return std::nullopt;
}

}  // namespace nef::planner
