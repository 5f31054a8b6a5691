// SPDX-License-Identifier: Apache-2.0
//
// CGAL's Minkowski sum of the same meshes, for comparison.
#pragma once

#include <cstddef>

#include "nef/construct/construct.h"

namespace nef::bench {

/// What CGAL made of a sum.
struct PeerResult {
  double seconds = 0;  ///< of the processor
  std::size_t vertices = 0, facets = 0, volumes = 0;
  std::size_t pieces = 0;  ///< convex pieces of the first operand
};

/// CGAL::minkowski_sum_3 of two closed solids over exact rational coordinates; time without the
/// conversion of the meshes.
PeerResult cgal_minkowski_sum(const Mesh& a, const Mesh& b);

}  // namespace nef::bench
