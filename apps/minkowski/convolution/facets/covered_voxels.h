// SPDX-License-Identifier: Apache-2.0
//
// Cubes that surely lie inside of the sum of two solids.
#pragma once

#include <cstdint>
#include <span>

#include "apps/minkowski/cells/bit_grid.h"
#include "apps/minkowski/convolution/facets/solid_features.h"
#include "nef/geometry/vectors.h"

namespace nef::minkowski {

/// A grid over the sum of two solids, with the cubes that lie in its inside (in int A + int B) as far as that is easily
/// seen: sums of a cube inside of A and one inside of B. Facets of the convolution that lie in such cubes have no part
/// in the boundary of the sum.
class CoveredVoxels {
 public:
  /// Covers nothing.
  CoveredVoxels() = default;
  /// `cells`: how many along the longest side of the larger solid, or fewer if sums would take long. Doubles suffice:
  /// whatever comes near a cube counts as on it. Without effect (nothing is covered) where coordinates leave too little
  /// of their digits, or one solid is too small to hold a cube. O(n cells^2), and what BitGrid::sum takes;
  /// on the threads of `monitor`.
  CoveredVoxels(const SolidFeatures& a, const SolidFeatures& b, std::uint32_t cells, const Monitor& monitor);

  /// True if a convex polygon lies in the inside of the sum; or a segment or point, as a polygon of so many corners.
  /// These are within 2^-50 relative of the truth, or within `error`. False tells nothing. O(cubes that it meets).
  [[nodiscard]] bool cover(std::span<const Double3> polygon, double error = 0) const;

 private:
  struct Raster {
    Double3 low{};
    BitGrid inside;
  };
  struct Drawing;
  static void draw(const std::vector<Double3>& polygon, Drawing& drawing);
  [[nodiscard]] Raster raster_of(const SolidFeatures& solid, const Monitor& monitor) const;

  double size_ = 0;  // of a cube; 0 if nothing is covered
  Double3 low_{};
  BitGrid covered_;
};

}  // namespace nef::minkowski
