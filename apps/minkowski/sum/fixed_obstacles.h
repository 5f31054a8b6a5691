// SPDX-License-Identifier: Apache-2.0
//
// Free positions of many solid robots among the same obstacles.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "apps/minkowski/sum/pair_sums.h"
#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// The sums of up to so many pairs of convex pieces, all in one union, take less time than sums by convolution
/// (measured).
inline constexpr std::size_t kFewPairsOfPieces = 100;

/// Obstacles that are cut up once, for the free positions of many robots among them. Each obstacle is its solid part,
/// the closure of its interior, and what is left of it: an open robot meets it iff it meets one of the two.
class FixedObstacles {
 public:
  /// The obstacles must be bounded; they are taken closed. If `may_touch`, contact is free, as for configuration_space,
  /// else any common point is a collision. The free positions are those within `box`, if there is one.
  FixedObstacles(std::span<const Polyhedron> obstacles, const std::optional<std::array<Rational3, 2>>& box,
                 bool may_touch, const Monitor& monitor);

  /// Convex pieces of the solid parts.
  [[nodiscard]] std::size_t solid_count() const { return solid_.size(); }

  /// The free positions of the origin of a robot that is the union of closed convex solids; with none, everything is
  /// free. Sums that cannot reach the box are left out. Throws Interrupted if `monitor` says so.
  [[nodiscard]] Polyhedron free_positions(std::span<const Mesh> robot, const Monitor& monitor) const;

 private:
  struct Box {
    Rational3 low, high;
  };
  static Box box_of(const Mesh& mesh);
  // True unless the sum of two convex sets is away from the box.
  [[nodiscard]] bool matters(const Box& a, const Box& b) const;

  bool may_touch_;
  std::optional<Box> box_;
  Polyhedron all_;  // of the box, or of space
  Operand solid_;
  std::vector<Box> solid_boxes_;
  std::vector<ConvexCell> flat_;
  std::vector<Box> flat_boxes_;
};

}  // namespace nef::minkowski
