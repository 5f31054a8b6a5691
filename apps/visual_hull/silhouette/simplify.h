// SPDX-License-Identifier: Apache-2.0
//
// Fewer vertices within a bound, without ever changing the topology.
#pragma once

#include "apps/visual_hull/polygon/polygon.h"

namespace nef::visual_hull {

/// How silhouettes are simplified.
struct SimplifyOptions {
  double tolerance = 0;  ///< pixels; zero drops straight vertices only
  bool outer = false;    ///< the result must contain the silhouette
};

/// A silhouette with fewer vertices, such that, for every tolerance,
///  1. each ring has Hausdorff distance at most `tolerance` from the ring it comes from;
///  2. rings are as many, simple and nested as before, and meet in the same vertices only;
///  3. with `outer`, it contains the given silhouette (exactly).
/// Vertices are original ones; with `outer` some are points beyond the original, on a grid of a
/// power of two between tolerance/16 and tolerance/8. Greedy, cheapest vertex first;
/// O(n log n) for n vertices of ordinary contours, with a chain of length O(tolerance) per vertex.
Silhouette simplify(const Silhouette& silhouette, const SimplifyOptions& options, const nef::Monitor& monitor = {});

}  // namespace nef::visual_hull
