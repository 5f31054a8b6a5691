// SPDX-License-Identifier: Apache-2.0
//
// The flat cases of convex hulls: what points on a line or in a plane span.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/number/number.h"

namespace nef::detail {

/// Indices of the two ends of points on one line with the given direction.
std::vector<std::uint32_t> linear_hull(std::span<const Rational3> points, const Rational3& direction);

/// Indices of the extreme points of points in one plane, counterclockwise about the normal.
/// O(n log n), exact.
std::vector<std::uint32_t> planar_hull(std::span<const Rational3> points, const Rational3& normal);

}  // namespace nef::detail
