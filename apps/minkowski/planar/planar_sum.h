// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of polygons in parallel planes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/planar/planar_polygon.h"
#include "nef/base/monitor.h"

namespace nef::minkowski {

/// A sum of polygons with holes, and where its corners come from.
struct PlanarSum {
  std::vector<Rational3> points;  ///< each one once
  /// Of each point, corners of P and Q that it is the sum of (of several, any); kNone where two segments cross.
  std::vector<std::array<std::uint32_t, 2>> sources;
  /// Points around the sum, which is on the left; the outer ring first. Straight corners are left out. A ring that
  /// comes to a point twice touches itself there.
  std::vector<std::vector<std::uint32_t>> rings;
};

/// P + Q for polygons with holes in parallel planes, which is such a polygon: exact. `frame` fits the planes of both.
/// O(n m) segments of the convolution; those that lie deep inside of the sum are dropped by a grid, and the others are
/// arranged: O(k log k) for k pairs that meet.
PlanarSum planar_sum(const PlanarPolygon& p, const PlanarPolygon& q, const PlanarFrame& frame, const Monitor& monitor);

}  // namespace nef::minkowski
