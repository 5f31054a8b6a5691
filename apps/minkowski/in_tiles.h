// SPDX-License-Identifier: Apache-2.0
//
// Sums, erosions and offsets of sets in tiles, region by region: in bounded memory and on several threads.
#pragma once

#include "apps/minkowski/minkowski.h"
#include "apps/minkowski/morphology.h"
#include "nef/polyhedron.h"
#include "nef/tiles/tiled_polyhedron.h"

namespace nef::minkowski {

/// A + B, A eroded by B, and the offset of A, as of a Polyhedron (minkowski.h, morphology.h), by regions on the threads
/// of the monitor. In memory are the parts of A around as many regions, their sums, and the tiles (Tiling::store). The
/// monitor is told of kSumPhase, in thousandths. In the report, equal choices of regions are one. Throw
/// UnsupportedError for unbounded sets, but for those of one mark. Cost: that of the sums of the parts, which overlap
/// as far as B reaches, O(n log n) beside them.
/// @{
TiledPolyhedron minkowski_sum(const TiledPolyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                              MinkowskiReport* report = nullptr);
TiledPolyhedron erode(const TiledPolyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                      MinkowskiReport* report = nullptr);
TiledPolyhedron offset(const TiledPolyhedron& a, const Rational& radius, int splits, Side side,
                       const MinkowskiOptions& options = {}, MinkowskiReport* report = nullptr);
/// @}

/// An erosion and a sum, or a sum and an erosion. B must not be empty (InputError).
/// @{
TiledPolyhedron opening(const TiledPolyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                        MinkowskiReport* report = nullptr);
TiledPolyhedron closing(const TiledPolyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                        MinkowskiReport* report = nullptr);
/// @}

}  // namespace nef::minkowski
