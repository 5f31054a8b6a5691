// SPDX-License-Identifier: Apache-2.0
//
// Faces that close the holes of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/number/number.h"

namespace nef {

/// The border of faces as closed loops, each of which names a vertex at most once: the sides that faces run through
/// more often one way than the other, against these faces and as often as that. There are always loops, since what
/// faces leave open is closed itself. Each is one of the fewest sides through one of its sides, given those before it.
/// `rings` holds the corners of faces. O(n log n), and for each loop a breadth-first search of as many steps as it has
/// sides.
std::vector<std::vector<std::uint32_t>> border_loops(const std::vector<std::vector<std::uint32_t>>& rings);

/// Cuts a loop into triangles of the least area in sum; [Barequet, Sharir 1995]. O(n^3) for n corners; from more than
/// 400 the ears of least area are cut first, O(n log n). Areas are doubles: they choose between triangulations, of
/// which each closes the loop.
std::vector<std::vector<std::uint32_t>> least_area_triangles(std::span<const Rational3> vertices,
                                                             const std::vector<std::uint32_t>& loop);

/// Which holes get a lid.
enum class LidShape : std::uint8_t {
  kFlat,  ///< those whose border lies in a plane and does not cross itself: a polygon
  kAny,   ///< all: others get triangles of least area
};

/// Faces for holes.
struct Lids {
  std::vector<std::vector<std::uint32_t>> faces;
  std::size_t holes = 0;  ///< closed by the faces
  std::size_t flat = 0;   ///< of them, by one polygon
  double share = 0;       ///< of the faces in the area of the mesh and its lids; not a number if that overflows
};

/// Lids for the holes of a mesh, `rings` being the corners of its faces.
Lids lids_for(std::span<const Rational3> vertices, const std::vector<std::vector<std::uint32_t>>& rings, LidShape shape,
              const Monitor& monitor);

}  // namespace nef
