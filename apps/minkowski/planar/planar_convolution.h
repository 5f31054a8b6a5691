// SPDX-License-Identifier: Apache-2.0
//
// The reduced convolution of two polygons: segments that the boundary of their sum is made of, and more.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/planar/planar_polygon.h"
#include "nef/base/monitor.h"

namespace nef::minkowski {

/// A side of one polygon, moved by a corner of the other: from and to are sums of corners.
struct ConvolutionSegment {
  std::array<std::uint32_t, 2> p{};  ///< corners of P at both ends; equal if the side is one of Q
  std::array<std::uint32_t, 2> q{};  ///< corners of Q
};

/// All sums of a side of one polygon and a convex corner of the other at which the two can touch from one side: the
/// direction of the side lies between those of the corner's sides (one end included, so that of two parallel sides each
/// is added to one end of the other).
///
/// Just left of each segment is the inside of P + Q: points just left of the side, moved by the corner. And the
/// segments cover the boundary of P + Q: but for finitely many, each of its points is a + b for a on a side and b at a
/// corner, or on a parallel side, whose local cones K_a and -K_b have no inside in common. A cone in the half-plane
/// beyond a side is convex. If b is on a parallel side, a + b is also the sum of an end of one of the two sides and a
/// point of the other, and these ends are convex: beyond a reflex one the other polygon would be entered. [Kaul,
/// O'Connor, Srinivasan 1991] Directions are sorted once, all other decisions compare their ranks: O((n + m) log (n +
/// m) + n m).
std::vector<ConvolutionSegment> planar_convolution(const PlanarPolygon& p, const PlanarPolygon& q,
                                                   const PlanarFrame& frame, const Monitor& monitor);

}  // namespace nef::minkowski
