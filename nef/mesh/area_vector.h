// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "nef/geometry/vectors.h"
#include "nef/mesh/mesh.h"

namespace nef {

/// Twice the area of a face, given by its corners, times the normal on the side from which they are seen
/// counterclockwise. O(n).
inline Rational3 area_vector(const Mesh& mesh, std::span<const std::uint32_t> face) {
  Rational3 area{};
  const Rational3& origin = mesh.vertices[face[0]];
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    const Rational3 triangle = cross(minus(mesh.vertices[face[i]], origin), minus(mesh.vertices[face[i + 1]], origin));
    for (std::size_t axis = 0; axis < 3; ++axis) area[axis] += triangle[axis];
  }
  return area;
}

}  // namespace nef
