// SPDX-License-Identifier: Apache-2.0
//
// Sums of sets that are closed polygons in parallel planes.
#pragma once

#include <optional>

#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace nef::minkowski {

/// A + B if both are bounded, closed, and unions of polygons in planes that are all parallel; else nothing. A planar
/// sum for each pair of facets.
std::optional<Polyhedron> sum_of_flat_sets(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor);

}  // namespace nef::minkowski
