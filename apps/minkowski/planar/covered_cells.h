// SPDX-License-Identifier: Apache-2.0
//
// Squares that surely lie inside of the sum of two polygons.
#pragma once

#include <array>
#include <cstdint>

#include "apps/minkowski/cells/bit_grid.h"
#include "apps/minkowski/planar/planar_polygon.h"

namespace nef::minkowski {

/// A grid over a sum of polygons, with the squares that lie in its inside as far as that is easily seen: sums of a
/// square inside of P and one inside of Q. Away from the boundary by more than a few squares, all are.
class CoveredCells {
 public:
  /// `cells`: how many along the longer side of the larger polygon, at most 1024. Doubles suffice: whatever comes near
  /// a square counts as on it. Without effect (nothing is covered) where coordinates leave too little of their digits.
  /// O(n + m + cells^3 / 64).
  CoveredCells(const PlanarPolygon& p, const PlanarPolygon& q, const PlanarFrame& frame, std::uint32_t cells);

  /// True if a closed segment lies in the inside of the sum; its ends are within 2^-50 relative of the truth. False
  /// tells nothing. O(squares of its box).
  [[nodiscard]] bool cover(const std::array<double, 2>& from, const std::array<double, 2>& to) const;

 private:
  struct Raster {
    std::array<double, 2> low{};
    BitGrid inside;
  };
  [[nodiscard]] Raster raster_of(const PlanarPolygon& polygon, const PlanarFrame& frame) const;

  double size_ = 0;   // of a square; 0 if nothing is covered
  double slack_ = 0;  // doubles are off by less
  std::array<double, 2> low_{};
  BitGrid covered_;
};

}  // namespace nef::minkowski
