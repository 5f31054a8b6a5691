// SPDX-License-Identifier: Apache-2.0
//
// Sums of convex polygons in parallel planes, with marks.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nef/number/number.h"

namespace nef::minkowski {

/// A convex polygon, a segment as a ring of two corners, or a point as a ring of one. Each item is in the set or not:
/// the inside, corners, and sides without their ends. Side i runs from corner i to the next one.
struct MarkedPolygon {
  std::vector<Rational3> corners;  ///< counterclockwise about a normal; some may be straight
  std::vector<std::uint8_t> corner_marks;
  std::vector<std::uint8_t> sides;
  std::uint8_t inside = 1;

  /// True if all of it is in the set; true if nothing of it is.
  [[nodiscard]] bool is_full() const;
  [[nodiscard]] bool is_void() const;
};

/// A corner of a sum: of which corners of the two it is the sum, its mark, and that of the side which begins there.
struct SumCorner {
  std::uint32_t p = 0, q = 0;
  std::uint8_t mark = 1, side = 1;
};

/// The border of p + q, cut wherever its marks may change: x is in the sum iff it is the sum of two points of the sets.
/// The inside of the sum is marked throughout if those of both are. The sum must have area. O(n m).
std::vector<SumCorner> polygon_sum(const MarkedPolygon& p, const MarkedPolygon& q, const Rational3& normal);

}  // namespace nef::minkowski
