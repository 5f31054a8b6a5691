// SPDX-License-Identifier: Apache-2.0
//
// Space as silhouettes vote on it: the points that at most two views exclude.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/visual_hull/refine/coherence.h"
#include "apps/visual_hull/refine/moving_camera.h"
#include "apps/visual_hull/refine/outline.h"
#include "nef/base/monitor.h"

namespace nef::visual_hull {

/// A point of a grid, and the views that exclude it.
struct VotedPoint {
  static constexpr std::uint16_t kNobody = 0xffff;

  Eigen::Vector3d at;
  std::uint16_t first = kNobody, second = kNobody;

  /// How many views exclude it, without one.
  [[nodiscard]] int against(std::size_t left_out) const {
    const auto counts = [left_out](std::uint16_t view) { return view != kNobody && view != left_out ? 1 : 0; };
    return counts(first) + counts(second);
  }
};

/// The points of a grid.
struct Votes {
  double step = 0;  ///< between neighbours
  std::vector<VotedPoint> points;
};

/// A grid of 128 points a side in the ball of the object, without the points that three views exclude or more. A view
/// excludes a point that it sees farther than `margin` pixels outside of its silhouette, and those behind it.
/// `outlines` has nothing for views without a vote. O(points * views) at worst; points far from the object take three.
Votes vote(const std::vector<refine::MovingCamera>& cameras,
           const std::vector<std::optional<refine::Outline>>& outlines, const refine::Ball& ball, double margin,
           const nef::Monitor& monitor);

}  // namespace nef::visual_hull
