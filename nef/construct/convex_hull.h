// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls of points, of whatever dimension they span.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/construct.h"

namespace nef {

/// A convex hull. Vertices are extreme points only; no two faces are coplanar.
struct Hull {
  /// -1 for no points; 0 one vertex; 1 two vertices and no face; 2 one face, counterclockwise about
  /// some normal; 3 a closed surface, faces counterclockwise from outside.
  int dimension = -1;
  Mesh mesh;
  std::vector<std::uint32_t> source;  ///< for each vertex of the mesh, the index of an input point there
};

/// The hull of any number of points; equal points may occur. Exact, O(n log n) expected for points
/// in general position and O(n^2) at worst (quickhull: Barber, Dobkin, Huhdanpaa, ACM TOMS 1996).
Hull hull_of(std::span<const Rational3> points, const Monitor& monitor = {});

}  // namespace nef
