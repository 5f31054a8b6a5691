// SPDX-License-Identifier: Apache-2.0
//
// Where three planes of viewing edges meet, in doubles with a bound.
#pragma once

#include <cstdint>

#include "apps/visual_hull/viewing_edges/edge_view.h"

namespace nef::visual_hull {

/// Parts of space overlap by so much of their halves, so that every point of space lies well inside of one.
inline constexpr double kOverlap = 0x1p-16;

/// A plane n . x + d = 0 in coordinates in which a part of space is the cube from -1 to 1.
struct CubePlane {
  Double3 normal{};
  double offset = 0;
  double error = 0;  ///< by which values in the cube may be wrong
  double size = 0;   ///< the sum of the normal's magnitudes
};

/// A point in these coordinates; each of them is off by less than `error`.
struct CubePoint {
  Double3 at{};
  double error = 0;
};

/// What a bound allows to say.
enum class Answer : std::uint8_t { kNo, kYes, kVague };

/// Whether the line in which two planes meet may pass the cube. `direction` is the cross product of their normals.
/// Never false if it does.
[[nodiscard]] bool may_meet_in_cube(const CubePlane& p, const CubePlane& q, const Double3& direction);

/// Where three planes meet; `pq`, `pr`, `qr` are cross products of the normals. kYes: in the cube, at `result`, with an
/// error below kOverlap / 8. kNo: nowhere in the cube but perhaps within kOverlap of its border. kVague: doubles do not
/// tell. O(1).
[[nodiscard]] Answer meet_in_cube(const CubePlane& p, const CubePlane& q, const CubePlane& r, const Double3& pq,
                                  const Double3& pr, const Double3& qr, CubePoint& result);

}  // namespace nef::visual_hull
