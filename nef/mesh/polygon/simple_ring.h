// SPDX-License-Identifier: Apache-2.0
//
// Whether a closed ring of points is a simple polygon.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh_points.h"

namespace nef {

/// True if the closed segments ab and cd, in one plane that projects one to one along `axis`, have a point in common.
bool segments_meet(const MeshPoints& points, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                   std::size_t axis, const Monitor& monitor);

/// Two sides of a ring that have more in common than the corner between neighbours, or none if the ring is a simple
/// polygon (which may have straight corners). Side i runs from ring[i] to the next corner. No corner may be repeated in
/// a row; the plane of the ring projects one to one along `axis`. The pair is the least one, the smaller side first.
/// O(n log n) for n sides, plus the pairs whose boxes overlap.
std::optional<std::array<std::uint32_t, 2>> sides_that_meet(const MeshPoints& points,
                                                            std::span<const std::uint32_t> ring, std::size_t axis,
                                                            const Monitor& monitor);

}  // namespace nef
