// SPDX-License-Identifier: Apache-2.0
//
// Whether closed rings of points are simple polygons.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh_points.h"

namespace nef {

/// Two sides of rings that have more in common than the corner between neighbours, or none if the rings are simple
/// polygons (which may have straight corners) apart from each other. The corners are given ring after ring, each ending
/// before the corner that ring_end says; side i runs from corner i to the next one of its ring. No corner may be
/// repeated in a row; the plane of the rings projects one to one along `axis`. The pair is the least one, the smaller
/// side first. O(n log n) for n sides, plus the pairs whose boxes overlap.
std::optional<std::array<std::uint32_t, 2>> sides_that_meet(const MeshPoints& points,
                                                            std::span<const std::uint32_t> corners,
                                                            std::span<const std::uint32_t> ring_end, std::size_t axis,
                                                            const Monitor& monitor);

}  // namespace nef
