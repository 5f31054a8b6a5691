// SPDX-License-Identifier: Apache-2.0
//
// How far two surfaces are from each other.
#pragma once

#include <cstddef>

#include "nef/mesh/mesh.h"

namespace nef {

/// What is proved about a distance: low <= distance <= high.
struct DistanceBounds {
  double low = 0;
  double high = 0;
};

/// Bounds of the Hausdorff distance of two surfaces, given as meshes of triangles (at least one each): the least D so
/// that each point of one is within D of the other. low is reached at some point up to rounding. Triangles in question
/// are halved until the two bounds are within a hundredth, or `splits` times. Rounding is part of the bounds,
/// also for coordinates beyond the range of doubles, where high may be infinite.
/// Throws InputError for faces that are not triangles. O((n + splits) log n) expected.
DistanceBounds hausdorff_distance(const Mesh& a, const Mesh& b, std::size_t splits);

}  // namespace nef
