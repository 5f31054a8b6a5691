// SPDX-License-Identifier: Apache-2.0
//
// Polygons with holes in a plane of space, as rings of exact points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/mesh/polygon/triangulate.h"
#include "nef/number/number.h"

namespace nef::minkowski {

/// A closed polygon: the closure of its inside, which is connected. Rings have the inside on the left as seen along an
/// axis (PlanarFrame); they may touch at corners but not cross. Corners may be straight; no side is walked both ways.
struct PlanarPolygon {
  std::vector<Rational3> corners;       ///< ring after ring
  std::vector<std::uint32_t> ring_end;  ///< of each ring, the corner after its last

  /// The corner after a corner on its ring. `ring` is the number of the ring.
  [[nodiscard]] std::uint32_t next(std::size_t ring, std::uint32_t corner) const {
    if (corner + 1 < ring_end[ring]) return corner + 1;
    return ring == 0 ? 0 : ring_end[ring - 1];
  }
};

/// How planes of one direction are looked at: along the axis, from its side if the sign is +1, else mirrored.
using PlanarFrame = ProjectionAxis;

/// The two coordinates that are seen.
inline std::size_t first_axis(const PlanarFrame& frame) { return (frame.axis + 1) % 3; }
inline std::size_t second_axis(const PlanarFrame& frame) { return (frame.axis + 2) % 3; }

}  // namespace nef::minkowski
