// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/no_path/barrier_bounds.h"

#include <algorithm>
#include <cmath>

#include "nef/geometry/vectors.h"

namespace nef::planner {

BarrierBounds::BarrierBounds(const PathProof::Claim& claim, const Rational3& reference, double reach) {
  const auto add = [&](const Rational3& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      exact[0][k] = std::min(exact[0][k], p[k]);
      exact[1][k] = std::max(exact[1][k], p[k]);
    }
  };
  double room = is_zero(reference) ? 0 : std::sqrt(nearest_double(dot(reference, reference))) * (1 + 0x1p-20);
  if (claim.box) {
    exact = *claim.box;
    // Boxes of poses have an extent.
    for (std::size_t k = 0; k < 3; ++k) {
      is_flat[k] = exact[0][k] == exact[1][k];
      if (is_flat[k]) room = std::max(room, reach / 64);
    }
  } else {
    exact = {claim.path.front().position, claim.path.front().position};
    add(claim.path.back().position);
    for (const std::vector<Rational3>& piece : claim.obstacles) std::for_each(piece.begin(), piece.end(), add);
    room += 2 * reach + 1;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (const std::size_t end : {0, 1}) {
      // A double that is no less far out.
      Rational& bound = exact[end][k];
      bound += (end == 0 ? -1 : 1) * exact_rational(room);
      double x = nearest_double(bound);
      if (end == 0 ? exact_rational(x) > bound : exact_rational(x) < bound) {
        x = std::nextafter(x, end == 0 ? -HUGE_VAL : HUGE_VAL);
      }
      bound = exact_rational(x);
      (end == 0 ? rough.low : rough.high)[static_cast<Eigen::Index>(k)] = x;
    }
  }
}

Vector3d reference_position(const RigidPose& pose, const Rational3& reference) {
  const Matrix3 turn = rotation_between(pose.quaternion, pose.quaternion);
  Rational3 at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = pose.position[k] + dot(turn[k], reference);
  return to_vector(at);
}

}  // namespace nef::planner
