// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/rigid/close_pieces.h"

#include <cmath>

namespace nef::planner {
namespace {

// As in separation.cpp: two images, and the sums and products around them. An infinite sum is not above an infinite
// error.
constexpr double kBoxError = 2 * MotionCell::kImageError;

}  // namespace

// The box of a node of the robot, turned, lies in that about M centre with the halves |M| half.
bool boxes_apart(const MotionCell& cell, const RigidBody::Node& a, const RigidBody::Node& b) {
  const double error = kBoxError * (2 * a.reach + b.reach + cell.position_reach) + cell.slack + MotionCell::kVanished;
  Vector3d low = Vector3d::Constant(HUGE_VAL);
  Vector3d high = Vector3d::Constant(-HUGE_VAL);
  for (std::size_t i = 0; i < cell.turn_count; ++i) {
    const Vector3d centre = cell.turns[i] * a.centre;
    const Vector3d half = cell.turns[i].cwiseAbs() * a.half;
    low = low.cwiseMin(centre - half);
    high = high.cwiseMax(centre + half);
  }
  Vector3d from = cell.positions[0];
  Vector3d to = from;
  if (cell.position_count == 2) {
    from = from.cwiseMin(cell.positions[1]);
    to = to.cwiseMax(cell.positions[1]);
  }
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (low[k] + from[k] > b.centre[k] + b.half[k] + error) return true;
    if (high[k] + to[k] < b.centre[k] - b.half[k] - error) return true;
  }
  return false;
}

void split(const NodePair& pair, const RigidBody::Node& a, const RigidBody::Node& b, std::vector<NodePair>& pairs) {
  const bool split_a = b.leaf || (!a.leaf && a.radius > b.radius);
  for (const std::uint32_t child : {0U, 1U}) {
    pairs.push_back(split_a ? NodePair{a.first + child, pair[1]} : NodePair{pair[0], b.first + child});
  }
}

}  // namespace nef::planner
